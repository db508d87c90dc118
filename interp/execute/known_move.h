// A move or a hole whose block is spelled as one before it, in the modes in which that was
// executed.
#pragma once

#include "interp/execute/plain_move.h"
#include "interp/state/copy_motion.h"

#include <optional>

namespace ncvet {

/// Where a hole leaves the tool along its axis.
enum class HoleEnd : uint8_t {
  None,     ///< it is no hole, but a move
  Initial,  ///< at the level where the cycle began
  Approach, ///< at its level of approach
  Higher    ///< at the higher one of both
};

/// All that executing such a block does: what its numbers do not decide as it was the last time,
/// and where they lead.
struct KnownMove {
  struct Code {
    uint8_t group;
    uint64_t members; ///< in force after the block
  };
  /// A part of the state that a word of the block has set.
  struct Place {
    uint8_t part; ///< index in `OriginState::all`
    uint8_t word; ///< index in `Block::words`
  };
  llvm::SmallVector<PlainMove::Step, 6> steps;
  llvm::SmallVector<uint8_t, 6> letters; ///< of a hole: of its steps, which its cycle keeps
  llvm::SmallVector<Code, 2> codes;      ///< of groups in which others were in force before it
  llvm::SmallVector<Place, 4> places;
  double unit = 1; ///< millimetres per programmed unit of length
  bool isRapid = false;
  bool tracksDepth = false;  ///< of a mill
  bool forgetsLevel = false; ///< from which the tool was fed down
  bool losesTool = false;    ///< where it is along its axis is not known before the move
  bool computes = false;     ///< expressions give some of the numbers
  bool isSimple = false;     ///< see `simpleAxes`
  bool engages = false;      ///< compensation: what is noted of it depends on the way along X
  bool renews = false;       ///< sets a part that may be older than the tool
  HoleEnd hole = HoleEnd::None;
  Axis tool = Axis::Z; ///< the axis along which it drills
  // As they are after the block.
  uint64_t statedMay = 0, statedMust = 0;
  uint64_t factsMay = 0, factsMust = 0;
  uint32_t machineAxes = 0;
  uint32_t cycleWords = 0;
  uint8_t idleBlocks = 0;
  uint8_t compensation = phaseOff;
  int32_t radiusOffset = notSet;
  Interval feed;

  /// Which of the modes that it may leave, all else being the same, `after` has: those differ in
  /// the side from which the tool comes to a contour, and in what is older than the tool.
  size_t variantOf(const MachineState &after) const {
    if (!engages && !renews)
      return 0;
    const auto holds = [&](Fact fact) { return size_t(after.factsMay & bitOf(fact) ? 1 : 0); };
    const auto isOlder = [&](StatePart part) { return size_t(after.origin.isOlder(part)); };
    return holds(Fact::EnteredInward) | holds(Fact::EnteredOutward) << 1 |
           isOlder(StatePart::Compensation) << 2 | isOlder(StatePart::Cycle) << 3;
  }
  static constexpr size_t variants = 16;

  /// Of `steps`, where expressions give some of them.
  using Numbers = llvm::SmallVector<double, 6>;
  /// Works them out; none where the words hold all of them. False: one of them is not known.
  bool compute(const Block &block, const MachineState &before, Numbers &numbers) const;
  /// Does to `state`, which equals `before`, what executing the block does, and puts the hole into
  /// `outcome`. `numbers`: as `compute` gives them.
  void make(const Block &block, FileId file, const MachineState &before, MachineState &state,
            Outcome &outcome, llvm::ArrayRef<double> numbers = {}) const;
  /// Makes `before`, the state before such a move, what `after` is.
  void catchUp(const MachineState &after, MachineState &before) const;

  /// Whether it is a hole that leaves `state` as it is, but for the place and the words that say
  /// it.
  bool onlyPlaces(const MachineState &state) const;
  /// As `make` and `catchUp`, of such a hole after another one.
  void makePlace(const Block &block, MachineState &state, Outcome &outcome) const {
    makeSimply(steps, block, state);
    drill(block, state, outcome, {});
  }
  void catchUpPlace(const MachineState &after, MachineState &before) const {
    copyMotion(before, after);
    for (const uint8_t letter : letters)
      before.cycle.value[letter] = after.cycle.value[letter];
  }

private:
  void moveBy(llvm::ArrayRef<double> numbers, const Block &block, MachineState &state) const;
  static void noteEntry(const MachineState &before, MachineState &state);
  void drill(const Block &block, MachineState &state, Outcome &outcome,
             llvm::ArrayRef<double> numbers) const;
};

} // namespace ncvet
