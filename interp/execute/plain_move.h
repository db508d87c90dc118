// A block of plain axis words: where its numbers lead in the modes in force.
#pragma once

#include "interp/state/event.h"
#include "interp/value/units.h"

namespace ncvet {

/// What a number of an axis word does to the position.
struct PlainTarget {
  Axis axis = Axis::X;
  bool isLength = false;     ///< in the unit of the program, not in degrees
  bool isHalved = false;     ///< a diameter
  bool isIncrement = false;  ///< counts from where the axis is
  bool inIncrements = false; ///< without a point the number counts least increments

  /// Moves the axis. `unit`: millimetres per programmed unit of length.
  void move(const Word &word, double unit, MachineState &state) const {
    double target = word.value() + 0.0;
    if (inIncrements && !(word.flags & wordPoint))
      target *= leastIncrement;
    move(target, unit, state);
  }
  /// The same by a number that was computed.
  void move(double target, double unit, MachineState &state) const {
    if (unit != 1 && isLength)
      target *= unit;
    if (isHalved)
      target *= 0.5;
    Interval &position = state.at(axis);
    if (isIncrement) {
      position.lo += target;
      position.hi += target;
    } else {
      position.lo = position.hi = target;
      state.machineAxes &= ~(uint32_t(1) << unsigned(axis));
    }
  }
};

/// A plain move that may be made again and again: all that its numbers do not decide.
struct PlainMove {
  struct Step {
    uint8_t word; ///< index in `Block::words`
    PlainTarget target;
  };
  struct Restated {
    uint8_t word;
    GroupIndex group; ///< of the code that the word states again
  };
  llvm::SmallVector<Step, 6> steps;
  llvm::SmallVector<Restated, 4> restated;
  double unit = 1;
  uint32_t simple = 0; ///< bit per axis of `steps` where they are simple, see `simpleAxes`; 0: not
  bool isRapid = false;
  bool tracksDepth = false; ///< of a mill

  /// Does what executing the block does, after a block that only differs in its numbers and that
  /// has left the same facts.
  void make(const Block &block, FileId file, const MachineState &before, MachineState &state) const;
  /// As `keepPlaces`, `make` and `leadsNowhere` one after the other.
  bool goOn(const Block &block, FileId file, MachineState &before, MachineState &state) const;
  /// Makes the places in `before`, from which the last such move led to `after`, those in `after`.
  void keepPlaces(const MachineState &after, MachineState &before) const {
    for (const Step &step : steps)
      before.at(step.target.axis) = after.at(step.target.axis);
  }
  /// Whether it was made and has left each of its axes where it was.
  bool leadsNowhere(const MachineState &before, const MachineState &after) const {
    return llvm::all_of(steps, [&](const Step &step) {
      return before.at(step.target.axis) == after.at(step.target.axis);
    });
  }

private:
  void restate(const Block &block, FileId file, MachineState &state) const;
};

/// Bit per axis of the steps when each number is a coordinate as it is; 0: one of them counts
/// otherwise, here or in a block that is spelled alike.
uint32_t simpleAxes(llvm::ArrayRef<PlainMove::Step> steps, const Block &block, double unit);

/// Makes simple steps, but for `MachineState::machineAxes`.
inline void makeSimply(llvm::ArrayRef<PlainMove::Step> steps, const Block &block,
                       MachineState &state) {
  for (const PlainMove::Step &step : steps) {
    Interval &position = state.at(step.target.axis);
    position.lo = position.hi = block.words[step.word].value() + 0.0;
  }
}

/// Keeps the level from which a mill's tool was fed in, and the area in which it has cut. The tool
/// is along Z whatever the plane: arcs in G18 and G19 lead in and out.
void trackDepth(const MachineState &before, MachineState &state, bool isRapid);

} // namespace ncvet
