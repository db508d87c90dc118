// A block of plain axis words: where its numbers lead in the modes in force.
#include "interp/execute/plain_move.h"

namespace ncvet {

inline void PlainMove::restate(const Block &block, FileId file, MachineState &state) const {
  for (const Restated &code : restated) {
    const Word &word = block.words[code.word];
    state.origin.setGroup(code.group, {file, word.offset, block.endOf(word)});
  }
}

void PlainMove::make(const Block &block, FileId file, const MachineState &before,
                     MachineState &state) const {
  restate(block, file, state);
  if (simple) {
    makeSimply(steps, block, state);
    state.machineAxes &= ~simple;
  } else {
    for (const Step &step : steps)
      step.target.move(block.words[step.word], unit, state);
  }
  if (tracksDepth)
    trackDepth(before, state, isRapid);
}

bool PlainMove::goOn(const Block &block, FileId file, MachineState &before,
                     MachineState &state) const {
  if (!simple) {
    keepPlaces(state, before);
    make(block, file, before, state);
    return leadsNowhere(before, state);
  }
  restate(block, file, state);
  bool isStill = true;
  for (const Step &step : steps) {
    Interval &position = state.at(step.target.axis);
    const double target = block.words[step.word].value() + 0.0;
    isStill &= position.lo == target && position.hi == target;
    before.at(step.target.axis) = position;
    position.lo = position.hi = target;
  }
  state.machineAxes &= ~simple;
  if (tracksDepth)
    trackDepth(before, state, isRapid);
  return isStill;
}

uint32_t simpleAxes(llvm::ArrayRef<PlainMove::Step> steps, const Block &block, double unit) {
  uint32_t axes = 0;
  for (const auto &[word, target] : steps) {
    if (block.words[word].has(wordExpression) || target.isHalved || target.isIncrement ||
        (target.inIncrements && !block.words[word].has(wordPoint)) ||
        (target.isLength && unit != 1))
      return 0;
    axes |= uint32_t(1) << unsigned(target.axis);
  }
  return axes;
}

void trackDepth(const MachineState &before, MachineState &state, bool isRapid) {
  constexpr Axis tool = Axis::Z;
  if (before.inMachineCoordinates(tool) == state.inMachineCoordinates(tool))
    state.fedFrom.move(before.at(tool), state.at(tool), isRapid);
  else
    state.fedFrom.forget();
  if (isRapid)
    return;
  for (unsigned i = 0; i < 2; ++i)
    state.cutArea.add(i, state.position[i]);
}

} // namespace ncvet
