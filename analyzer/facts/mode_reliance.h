// Which later block relies on a mode that was changed at one place and not stated again.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// What changed at one place of a program.
struct ModeChanges {
  uint64_t groups = 0; ///< bit per modal group of the dialect
  bool tool = false;
  bool any() const { return groups || tool; }
};

/// Bit mask of those standard groups that the dialect has.
uint64_t groupMask(const Dialect &dialect, std::initializer_list<StandardGroup> groups);

/// Looks through the text after the current block for the first block with axis words that uses
/// some of `changes` before they are stated again; `user` gets its range. Gives nothing when there
/// is none within some dozens of blocks, or where the text alone does not tell what runs next: at
/// calls, jumps, returns, ends and codes without a table entry. Skippable blocks are passed over.
ModeChanges firstReliance(const RuleContext &ctx, ModeChanges changes, SourceRange &user);

/// Title of the first of the changes, for messages: "plane", "tool".
std::string titleOf(const ModeChanges &changes, const Dialect &dialect);

} // namespace ncvet
