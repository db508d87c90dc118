// Blocks in the language of another control are known by its codes and signs; nothing else of them
// is judged.
#pragma once

#include "analyzer/facts/lookahead.h"
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

/// Another control's end of a subprogram somewhere before this control's own return, where programs
/// are called by their names alone: it tells the machine something, as any M code may.
inline bool isSignal(const CodeInfo &code, const RuleContext &ctx) {
  if (!code.foreign || code.letter != 'M' || code.action != Action::None ||
      !ctx.dialect().lexical.callMark.empty() || ctx.block().hasAny(~lettersMask("MN")))
    return false;
  constexpr unsigned furthest = 20; // blocks
  const uint32_t end = ctx.index().programAt(ctx.block().begin).end;
  Block block;
  uint32_t at = ctx.block().next;
  for (unsigned i = 0; i < furthest && at < end; ++i) {
    ctx.index().reader().read(at, block);
    at = std::max(block.next, at + 1);
    if (findCode(ctx.dialect(), block, {Action::Return}))
      return i > 0; // side by side they are two ends
  }
  return false;
}

} // namespace ncvet
