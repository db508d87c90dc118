// The paths along which a turning cycle may find its profile: with the blocks that a switch leaves
// out, and without them.
#pragma once

#include "analyzer/facts/lookahead.h"

namespace ncvet {

/// A profile as it is read with the switch of block skip off or on.
struct ProfileWay {
  Profile profile;
  SourceRange skippable;  ///< the first block that the switch leaves out; empty: there is none
  bool leavesOut = false; ///< the switch is on
  bool always = true;     ///< there is no such block: the profile is the same on every path

  /// Says in a finding on which of the paths it holds.
  void explain(FindingBuilder &finding) const {
    if (!always)
      finding.note(skippable, leavesOut ? "when block skip leaves this block out"
                                        : "when block skip is off and this block runs");
  }
};

/// The profile of the cycle that the current block runs, see `readProfile`: first with all of its
/// blocks, then, where a switch leaves some of them out, without these. The shape is not known
/// where several switches decide.
llvm::SmallVector<ProfileWay, 2> profileWays(const RuleContext &ctx);

} // namespace ncvet
