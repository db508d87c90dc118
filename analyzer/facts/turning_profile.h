// The blocks of a turning profile: as they are, and along which paths a cycle may find them.
#pragma once

#include "analyzer/facts/lookahead.h"

#include <deque>

namespace ncvet {

/// One block of a profile, executed for itself.
struct ProfileBlock {
  SourceRange range; ///< the block's words
  Block block;
  llvm::SmallVector<CodeUse, 4> codes;
  bool moves = false;
  MotionKind motion = MotionKind::Rapid;
  bool motionKnown = false;
  uint16_t axes = 0;
  Interval fromX, fromZ, toX, toZ; ///< mm, X as programmed
};

enum class Side : uint8_t { Unknown, Outside, Inside };

/// The blocks that a turning cycle works along.
struct Profile {
  bool known = false;              ///< false: the blocks are not there, or not a plain list
  std::deque<ProfileBlock> blocks; ///< stays where it is: the codes point into it
  size_t lastCut = 0;              ///< index after the last block that belongs to the contour
  /// Least and greatest X and Z of the contour, from the first block's end point on; none when one
  /// end point is not known.
  std::optional<double> minX, maxX, minZ, maxZ;
  /// Least and greatest X of the end points that are known: the contour reaches at least so far.
  Interval reachesX = emptyInterval;
  Side side = Side::Unknown;
};

/// Reads the profile of the cycle that the current block runs (`Outcome::flow` names its blocks).
/// `startX`, `startZ`: where the cycle begins, for the side.
Profile readProfile(const RuleContext &ctx);

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
