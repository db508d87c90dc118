// The blocks between a cause and the current block, as far as the text tells the way.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// Gives `look` each block after that of `origin`, as far as the current one, in the order in which
/// they are executed when nothing jumps: those of the programs that called one another, each as far
/// as its call. The blocks of the calls are left out. An origin in a program that the current one
/// has called and that has returned counts too. Ends when `look` says false. False when it did, and
/// when the origin is in none of these programs.
bool blocksSince(const Origin &origin, const RuleContext &ctx,
                 llvm::function_ref<bool(const FileUnit &, const Block &)> look);

} // namespace ncvet
