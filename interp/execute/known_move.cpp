// A move or a hole whose block is spelled as one before it, in the modes in which that was
// executed.
#include "interp/execute/known_move.h"

#include "interp/evaluate/known_number.h"

#include <cmath>

namespace ncvet {

bool KnownMove::compute(const Block &block, const MachineState &before, Numbers &numbers) const {
  numbers.clear();
  if (!computes)
    return true;
  for (const PlainMove::Step &step : steps) {
    const Word &word = block.words[step.word];
    const std::optional<double> number = word.has(wordExpression)
                                             ? knownNumber(block, uint16_t(word.mantissa), before)
                                             : word.value() + 0.0;
    if (!number)
      return false;
    numbers.push_back(*number);
  }
  return true;
}

void KnownMove::make(const Block &block, FileId file, const MachineState &before,
                     MachineState &state, Outcome &outcome, llvm::ArrayRef<double> numbers) const {
  for (const Place &place : places) {
    const Word &word = block.words[place.word];
    state.origin.all()[place.part] = {file, word.offset, block.endOf(word)};
  }
  for (const Code &code : codes)
    state.groups[code.group] = code.members;
  state.statedMay = statedMay;
  state.statedMust = statedMust;
  state.factsMay = factsMay;
  state.factsMust = factsMust;
  state.feed.peek() = feed;
  state.idleBlocks = idleBlocks;
  state.compensation = compensation;
  state.radiusOffset.peek() = radiusOffset;
  if (forgetsLevel)
    state.fedFrom.forget();
  if (losesTool)
    state.at(tool) = Interval::unknown();
  if (isSimple)
    makeSimply(steps, block, state);
  else if (computes)
    moveBy(numbers, block, state);
  else
    for (const PlainMove::Step &step : steps)
      step.target.move(block.words[step.word], unit, state);
  state.machineAxes = machineAxes;
  if (engages)
    noteEntry(before, state);
  if (hole != HoleEnd::None)
    drill(block, state, outcome, numbers);
  else if (tracksDepth)
    trackDepth(before, state, isRapid);
}

/// Where expressions give some of the numbers.
void KnownMove::moveBy(llvm::ArrayRef<double> numbers, const Block &block,
                       MachineState &state) const {
  for (size_t i = 0; i < steps.size(); ++i) {
    const Word &word = block.words[steps[i].word];
    if (word.has(wordExpression))
      steps[i].target.move(numbers[i], unit, state);
    else
      steps[i].target.move(word, unit, state);
  }
}

/// From which side the tool comes to its contour.
void KnownMove::noteEntry(const MachineState &before, MachineState &state) {
  const Interval way = state.at(Axis::X) - before.at(Axis::X);
  const uint64_t side = way.hi < 0   ? bitOf(Fact::EnteredInward)
                        : way.lo > 0 ? bitOf(Fact::EnteredOutward)
                                     : 0;
  constexpr uint64_t both = bitOf(Fact::EnteredInward) | bitOf(Fact::EnteredOutward);
  state.factsMay = (state.factsMay & ~both) | side;
  state.factsMust = (state.factsMust & ~both) | side;
}

void KnownMove::drill(const Block &block, MachineState &state, Outcome &outcome,
                      llvm::ArrayRef<double> numbers) const {
  CycleWords &cycle = state.cycle;
  for (size_t i = 0; i < steps.size(); ++i) {
    const Word &word = block.words[steps[i].word];
    cycle.value[letters[i]] = word.has(wordExpression) ? numbers[i] : word.value();
  }
  cycle.present = cycleWords;
  outcome.holes[0] = state.position;
  if (tracksDepth)
    for (unsigned i = 0; i < 2; ++i)
      state.cutArea.add(i, state.position[i]);
  const Interval &initial = state.initialLevel;
  if (hole == HoleEnd::Initial) {
    state.at(tool) = initial;
    return;
  }
  const double height = cycle.get('R');
  const Interval approach =
      std::isnan(height) ? Interval::unknown() : Interval::exactly(height * unit);
  if (hole == HoleEnd::Approach)
    state.at(tool) = approach;
  else if (initial.isConstant() && approach.isConstant())
    state.at(tool) = Interval::exactly(std::max(initial.value(), approach.value()));
  else
    state.at(tool) = Interval::unknown();
}

bool KnownMove::onlyPlaces(const MachineState &state) const {
  return hole != HoleEnd::None && isSimple && places.empty() && codes.empty() && !computes &&
         !engages && !renews && !losesTool && state.fedFrom.peek().isUnknown() &&
         state.statedMay == statedMay && state.statedMust == statedMust &&
         state.factsMay == factsMay && state.factsMust == factsMust &&
         state.machineAxes == machineAxes && state.cycle.present == cycleWords &&
         state.idleBlocks == idleBlocks && state.compensation == compensation &&
         state.radiusOffset.peek() == radiusOffset && state.feed.peek() == feed;
}

void KnownMove::catchUp(const MachineState &after, MachineState &before) const {
  copyMotion(before, after);
  for (const Place &place : places)
    before.origin.all()[place.part] = after.origin.all()[place.part];
  for (const Code &code : codes)
    before.groups[code.group] = code.members;
  before.statedMay = statedMay;
  before.statedMust = statedMust;
  before.idleBlocks = idleBlocks;
  before.compensation = compensation;
  before.radiusOffset.peek() = radiusOffset;
  if (hole == HoleEnd::None)
    return;
  for (const uint8_t letter : letters)
    before.cycle.value[letter] = after.cycle.value[letter];
  before.cycle.present = cycleWords;
}

} // namespace ncvet
