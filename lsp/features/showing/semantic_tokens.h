// Semantic tokens: what each piece of a program's text is, for an editor's colours.
#pragma once

#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

enum class TokenType : uint8_t {
  Code,          ///< a code of motion, mode or cycle: `G01`, `TRANS`, `CYCLE81`
  Miscellaneous, ///< `M03`
  Keyword,       ///< a word of structured flow, jumps and definitions: `IF`, `GOTO`, `DEF`
  Axis,          ///< address of a coordinate: the `X` of `X10`
  Parameter,     ///< any other address, or the name of an argument
  Number,
  Variable,
  Function, ///< of an expression: `SIN`
  Program,  ///< name or number of a program
  Label,    ///< name or number of a block, where it is defined and where it is used
  Symbol,   ///< a name with a fixed meaning: an axis, `ON`
  Type,     ///< of a variable: `REAL`
  Operator, ///< `+`, `=`, `EQ`; the slash of block skip
  String,
  Comment,
  Count
};
/// The types in the words of the editors' protocol, in the order of the enumeration.
llvm::ArrayRef<llvm::StringLiteral> tokenTypeNames();

enum TokenModifier : uint8_t {
  tokenDefinition = 1, ///< a label, program or variable where it is made
  tokenUnknown = 2     ///< no code or address of this control
};
/// The modifiers in the words of the editors' protocol, by bit.
llvm::ArrayRef<llvm::StringLiteral> tokenModifierNames();

struct SemanticToken {
  uint32_t begin = 0, end = 0; ///< bytes; never over the end of a line
  TokenType type = TokenType::Number;
  uint8_t modifiers = 0;

  friend bool operator==(const SemanticToken &, const SemanticToken &) = default;
};

/// The tokens that touch [begin, end), ascending, none over another.
std::vector<SemanticToken> semanticTokens(Snapshot &snapshot, uint32_t begin, uint32_t end);
/// Those of the whole text.
inline std::vector<SemanticToken> semanticTokens(Snapshot &snapshot) {
  return semanticTokens(snapshot, 0, uint32_t(snapshot.text().size()));
}

} // namespace ncvet::lsp
