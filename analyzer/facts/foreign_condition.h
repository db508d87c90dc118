// Signs and words that other languages have in the head of a condition or a loop.
#pragma once

#include "formats/readers/block.h"

namespace ncvet {

/// A sign of another language, with what is written here instead; empty when there is none.
struct ForeignSign {
  size_t at = llvm::StringRef::npos; ///< in the text of the condition
  llvm::StringRef foreign, own;
  explicit operator bool() const { return !foreign.empty(); }
};

/// Looks for `&&`, `||`, `!=`, and for the DO after the condition of a loop, in the text from the
/// statement to the end of its block. Only controls that compare with `==` and `<>` ask.
inline ForeignSign foreignSignIn(const Item &item, llvm::StringRef text) {
  const bool structure = item.kind == ItemKind::Structure;
  text = text.split(';').first.rtrim();
  if ((!structure && item.kind != ItemKind::If) || text.contains('"'))
    return {};
  constexpr std::pair<llvm::StringLiteral, llvm::StringLiteral> signs[] = {
      {"&&", "AND"}, {"||", "OR"}, {"!=", "<>"}};
  for (const auto &[foreign, own] : signs)
    if (const size_t at = text.find(foreign); at != llvm::StringRef::npos)
      return {at, foreign, own};
  const bool loop =
      structure && (item.structure == Structure::While || item.structure == Structure::For);
  if (loop && text.endswith_insensitive(" do"))
    return {text.size() - 2, text.take_back(2), ""};
  return {};
}

} // namespace ncvet
