// An occurrence of a name in a program text: of which kind, what it does there, and its key.
#pragma once

#include "analyzer/program/project.h"

namespace ncvet::lsp {

enum class NameKind : uint8_t {
  Program,    ///< by its number or its name
  Block,      ///< by its number
  Label,      //
  Variable,   ///< with a number or a name; an array as a whole
  Subprogram, ///< between brackets of structured flow: `o100 sub`
  Bracket,    ///< label of other structured flow: `o101 if [..]`
  Macro,      ///< a name that is replaced by words
  Element,    ///< of a contour: `L1`, `P2`
  Tool        ///< by the number of a T word
};

/// What a place does with the name that it holds.
enum class NameUse : uint8_t {
  Definition,  ///< header, number before a block, label, DEF, parameter, opening bracket
  Declaration, ///< says that it exists elsewhere, or names it once more: EXTERN, PROC
  Write,       ///< a variable gets a value
  Read,        ///< a variable's value, a tool, an element; the other ends of a bracket
  Call,        ///< a program or subprogram runs, or is read as a contour
  Jump,        ///< control goes there, or a section of the program begins or ends there
  Return,      ///< the block of the caller at which it goes on
  First,       ///< first block of a profile or of a section that runs again
  Last         ///< its last block
};

constexpr uint32_t wholeFile = 0xFFFFFFFF; ///< scope of what all programs of a file share
constexpr uint32_t otherFile = 0xFFFFFFFE; ///< scope of a block of a program that lies elsewhere

/// A place in the text that holds a name. Two occurrences of one file with the same kind, scope and
/// key name the same thing.
struct Occurrence {
  uint64_t key = 0;            ///< number, key of the variable, or a hash of the name
  uint32_t begin = 0, end = 0; ///< the name itself: digits without N or P, a label without marks
  uint32_t scope = wholeFile;  ///< index into `Names::scopes`, or one of the two above
  NameKind kind = NameKind::Block;
  NameUse use = NameUse::Read;
  Search search = Search::Anywhere; ///< of a jump: where its target is looked for
};

/// A program, or a subprogram between brackets in it: what names of its own belong to.
struct Scope {
  uint32_t begin = 0, end = 0;
  uint32_t program = 0; ///< index into the programs of the file
};

/// What a program does that its text does not tell the names of: first place each, or `nowhere`.
struct UntoldNames {
  static constexpr uint32_t nowhere = 0xFFFFFFFF;
  uint32_t target = nowhere;   ///< `GOTO #1`: any block may be meant
  uint32_t variable = nowhere; ///< `#[#1]`: any numbered variable may be meant
  uint32_t call = nowhere;     ///< a call whose program only the run decides
};

/// Keys of programs: by number the number itself, by name one after all numbers.
uint64_t programKey(llvm::StringRef name);
/// Key of a label as `Reader::labelKey` gives it.
uint64_t labelKeyOf(const Reader &reader, llvm::StringRef label);

} // namespace ncvet::lsp
