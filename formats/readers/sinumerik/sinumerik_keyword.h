// Words of the Sinumerik language that open a statement.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <cstdint>

namespace ncvet {

/// Words of the language that are no code: they open a statement.
enum class SinumerikKeyword : uint8_t {
  None,
  If,
  Else,
  EndIf,
  Loop,
  EndLoop,
  For,
  EndFor,
  While,
  EndWhile,
  Repeat,
  RepeatBlock,
  Until,
  Goto,
  GotoForward,
  GotoBackward,
  GotoIfFound,
  GotoStart,
  Case,
  Def,
  Proc,
  Extern,
  Define,
  ModalCall,
  Call,
  PathCall,
  ExternalCall,
  Redefine,
  When,    ///< the condition of a synchronised action
  Do,      ///< its actions
  Identity ///< its number
};

/// The keyword that a name is, in any case of letters; `None` for other names.
SinumerikKeyword sinumerikKeyword(llvm::StringRef name);

inline bool isJump(SinumerikKeyword keyword) {
  return keyword >= SinumerikKeyword::Goto && keyword <= SinumerikKeyword::GotoStart;
}

} // namespace ncvet
