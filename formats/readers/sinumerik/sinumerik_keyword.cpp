// Words of the Sinumerik language that open a statement.
#include "formats/readers/sinumerik/sinumerik_keyword.h"

#include "llvm/ADT/StringSwitch.h"

namespace ncvet {

SinumerikKeyword sinumerikKeyword(llvm::StringRef name) {
  if (name.size() > 8)
    return SinumerikKeyword::None;
  return llvm::StringSwitch<SinumerikKeyword>(name.upper())
      .Case("IF", SinumerikKeyword::If)
      .Case("ELSE", SinumerikKeyword::Else)
      .Case("ENDIF", SinumerikKeyword::EndIf)
      .Case("LOOP", SinumerikKeyword::Loop)
      .Case("ENDLOOP", SinumerikKeyword::EndLoop)
      .Case("FOR", SinumerikKeyword::For)
      .Case("ENDFOR", SinumerikKeyword::EndFor)
      .Case("WHILE", SinumerikKeyword::While)
      .Case("ENDWHILE", SinumerikKeyword::EndWhile)
      .Case("REPEAT", SinumerikKeyword::Repeat)
      .Case("REPEATB", SinumerikKeyword::RepeatBlock)
      .Case("UNTIL", SinumerikKeyword::Until)
      .Case("GOTO", SinumerikKeyword::Goto)
      .Case("GOTOF", SinumerikKeyword::GotoForward)
      .Case("GOTOB", SinumerikKeyword::GotoBackward)
      .Case("GOTOC", SinumerikKeyword::GotoIfFound)
      .Case("GOTOS", SinumerikKeyword::GotoStart)
      .Case("CASE", SinumerikKeyword::Case)
      .Case("DEF", SinumerikKeyword::Def)
      .Case("PROC", SinumerikKeyword::Proc)
      .Case("EXTERN", SinumerikKeyword::Extern)
      .Case("DEFINE", SinumerikKeyword::Define)
      .Case("MCALL", SinumerikKeyword::ModalCall)
      .Case("CALL", SinumerikKeyword::Call)
      .Case("PCALL", SinumerikKeyword::PathCall)
      .Case("EXTCALL", SinumerikKeyword::ExternalCall)
      .Case("ISOCALL", SinumerikKeyword::ExternalCall)
      .Case("REDEF", SinumerikKeyword::Redefine)
      .Cases("WHEN", "WHENEVER", "FROM", "EVERY", SinumerikKeyword::When)
      .Case("DO", SinumerikKeyword::Do)
      .Cases("ID", "IDS", SinumerikKeyword::Identity)
      .Default(SinumerikKeyword::None);
}

} // namespace ncvet
