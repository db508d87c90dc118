// Blocks in the language of another control are known by its codes and signs; nothing else of them
// is judged.
#pragma once

#include "analyzer/rule/rule.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {

/// `O1000`, `#1=5`: a program's number and a variable, as ISO controls write them.
inline bool isIsoSign(llvm::StringRef text) {
  return text.size() > 1 && (text[0] == '#' || text[0] == 'O' || text[0] == 'o') &&
         llvm::isDigit(text[1]);
}

/// Whether a code of the block is another control's: its words are that code's then.
inline bool holdsForeignCode(const RuleContext &ctx) {
  return llvm::any_of(ctx.codes(), [&](const CodeUse &use) { return ctx.code(use).foreign; });
}

} // namespace ncvet
