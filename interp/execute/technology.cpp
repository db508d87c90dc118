// Feed, speed, tool and offset words, and the codes of spindle and tool.
#include "formats/dialect/control_facts.h"
#include "interp/execute/execution.h"

#include <cmath>

namespace ncvet {

/// Of H and D, those that a cycle takes for itself: a depth of cut, the number of spring passes.
static AddressMask ownNumbers(const CodeInfo &code) {
  if (code.action != Action::Cycle)
    return 0;
  AddressMask own = code.takes & maskOf('D');
  for (const WordSpec &spec : code.words)
    if (spec.role != Role::None && spec.role != Role::Offset)
      own |= spec.any & maskOf('H');
  return own;
}

/// What the block's codes make of its F, S, T, H, D and E.
Execution::TechnologyUse Execution::technologyUse() const {
  TechnologyUse use;
  for (const CodeUse &of : outcome_.codes) {
    const CodeInfo &code = info(of);
    use.limit |= code.action == Action::SpeedLimit;
    if (code.action == Action::Dwell)
      use.dwell |= code.takes;
    use.arguments |= code.action == Action::MacroCall || code.action == Action::MacroModal;
    use.lead |= code.action == Action::Thread || cutsThread(code.cycle);
    use.ofCycle |= ownNumbers(code);
  }
  if (!use.lead && !use.arguments)
    if (const CodeInfo *motion = state_.activeCode(dialect_, StandardGroup::Motion))
      use.lead = motion->action == Action::Thread || motion->cycle == CycleKind::ThreadPass;
  return use;
}

/// F, S, T, H and D.
void Execution::technologyWords() {
  constexpr AddressMask technology = lettersMask("FSTHDE");
  if (!(block_.addresses & technology))
    return;
  const TechnologyUse use = technologyUse();
  if (use.arguments)
    return;
  for (const Word &word : block_.words) {
    if (use.dwell & maskOf(word.address)) // a time, or revolutions
      continue;
    switch (word.address) {
    case letterAddress('E'):
      if (use.lead)
        feedWord(word, true);
      break;
    case letterAddress('F'):
      feedWord(word, use.lead);
      break;
    case letterAddress('S'):
      speedWord(word, use.limit);
      break;
    case letterAddress('T'):
      if (state_.profile != ProfileMode::Recorded)
        toolWord(word);
      break;
    case letterAddress('H'):
    case letterAddress('D'):
      offsetWord(word, use.ofCycle);
      break;
    default:
      break;
    }
  }
}

void Execution::feedWord(const Word &word, bool lead) {
  if (state_.profile == ProfileMode::Recorded)
    return;
  state_.feed = value(word);
  state_.origin.set(StatePart::Feed, originOf(word));
  state_.set(Fact::FeedSet);
  state_.clear(Fact::FeedCarried);
  if (lead)
    state_.set(Fact::FeedIsLead);
  else
    state_.clear(Fact::FeedIsLead);
  Event &event = outcome_.emit(EventKind::FeedWord);
  event.word = &word;
  event.setWordValue(state_.feed);
}

void Execution::speedWord(const Word &word, bool limit) {
  if (state_.profile == ProfileMode::Recorded)
    return;
  outcome_.setupChanged = true;
  Event &event = outcome_.emit(EventKind::SpeedWord);
  event.word = &word;
  event.setSpeed(value(word), limit);
  if (limit) {
    state_.speedLimit = event.speed();
    state_.set(Fact::SpeedLimitSet);
  } else {
    state_.speed = event.speed();
    state_.origin.set(StatePart::Speed, originOf(word));
    state_.set(Fact::SpeedSet);
    state_.set(Fact::SpeedSinceMode);
  }
}

/// H or D.
void Execution::offsetWord(const Word &word, AddressMask ofCycle) {
  // A D that is a length says something of the tool's length only: D0 takes it away.
  const AddressInfo &address = dialect_.addresses[word.address];
  const bool isD = word.address == letterAddress('D') && address.unit != AddressUnit::Length;
  if ((isD || word.address == letterAddress('H')) && (ofCycle & maskOf(word.address)))
    return;
  if (address.kind == AddressKind::Increment || address.kind == AddressKind::Unknown)
    return;
  outcome_.setupChanged = true;
  const Interval number = value(word);
  const int32_t offset =
      number.isConstant() && std::fabs(number.value()) < 1e6 ? int32_t(number.value()) : notKnown;
  // A new H while the length offset is on is taken at once.
  if (!isD && (offset != 0 || dialect_.isLathe()) &&
      state_.isActive(dialect_, StandardGroup::LengthOffset,
                      {Action::LengthPositive, Action::LengthNegative}) == Truth::Yes)
    state_.set(Fact::LengthSinceTool);
  if (isD)
    state_.radiusOffset = offset;
  else
    state_.lengthOffset = offset;
  state_.origin.set(isD ? StatePart::RadiusOffset : StatePart::LengthOffset, originOf(word));
  Event &event = outcome_.emit(EventKind::OffsetWord);
  event.word = &word;
  event.setWordValue(number);
}

void Execution::otherSpindles() {
  for (const Item &item : block_.items)
    otherSpindle(item);
}

/// `M2=3`: another spindle turns from here on, and may be the one that cuts. `S3=2500`: where it
/// may have become that one, this is its speed.
void Execution::otherSpindle(const Item &item) {
  if (item.kind != ItemKind::Output || item.target == noExpression)
    return;
  if (item.count != noExpression) {
    constexpr double clockwise = 3, counterClockwise = 4, stop = 5;
    const Value function = evaluate(block_, item.value, state_, nullptr);
    const double number = function.isConstant() ? function.number.value() : clockwise;
    if (number == clockwise || number == counterClockwise) {
      outcome_.setupChanged = true;
      state_.liveTool = number == clockwise ? spindleCw : spindleCcw;
    } else if (number == stop && state_.liveTool != spindleOff) {
      state_.liveTool = spindleAny; // which one has stopped is not kept
    }
    return;
  }
  if (state_.spindle != spindleAny && state_.liveTool == spindleOff)
    return;
  outcome_.setupChanged = true;
  state_.speed = Interval::unknown();
  state_.origin.set(StatePart::Speed, {file_, item.begin, item.end});
  state_.set(Fact::SpeedSet);
  state_.set(Fact::SpeedSinceMode);
}

/// Words that set something without a code: a feed of a tooth, a limit of the speed, a position of
/// the spindle.
void Execution::settingWords() {
  for (const Word &word : block_.words) {
    const AddressMask mask = maskOf(word.address);
    if (mask & dialect_.feedWords) {
      state_.feed = Interval::unknown();
      state_.origin.set(StatePart::Feed, originOf(word));
      state_.set(Fact::FeedSet);
      state_.clear(Fact::FeedCarried);
      state_.clear(Fact::FeedIsLead);
    } else if (mask & dialect_.speedLimitWords) {
      state_.speedLimit = value(word);
      state_.set(Fact::SpeedLimitSet);
    } else if (mask & dialect_.orientWords) {
      state_.spindle = spindleOriented;
      state_.set(Fact::OrientedSinceTool);
      state_.set(Fact::SpindleStated);
      state_.origin.set(StatePart::Spindle, originOf(word));
    } else if (mask & dialect_.switchWords) {
      const unsigned index = dialect_.addresses[word.address].switches;
      const Interval v = value(word);
      const bool off = v.isConstant() && v.value() == 0, on = v.isConstant() && !off;
      state_.switches.put(index, !off, on, state_.switches.axesOf(index));
      state_.origin.setSwitch(index, originOf(word));
    }
  }
}

void Execution::setSpindle(uint8_t direction, const CodeUse &use) {
  state_.spindle = direction;
  state_.set(Fact::SpindleStated);
  state_.clear(Fact::SpindleStoppedByTap);
  state_.origin.set(StatePart::Spindle, originOf(*use.word));
}

void Execution::orientSpindle(const CodeUse &use) {
  setSpindle(spindleOriented, use);
  state_.set(Fact::OrientedSinceTool);
}

/// The machine's builder knows what the code does.
void Execution::turnAnything(const CodeUse &) { turnAnySpindle(); }

/// A G code that a remap makes takes the words that it names: where the tool is after it is not
/// known.
bool Execution::runUnknown(const CodeUse &use, uint16_t axes) {
  const CodeInfo &code = info(use);
  if (!code.exclusive || !axes)
    return false;
  for (Interval &place : state_.position)
    place = Interval::unknown();
  state_.fedFrom.forget();
  return true;
}

void Execution::turnAnySpindle() {
  state_.spindle = spindleAny;
  if (!hasOneSpindle(dialect_))
    state_.liveTool = spindleAny;
  state_.clear(Fact::SpindleStoppedByTap);
}

/// Whether a code of the block sets the spindle going, before another one or after it.
bool Execution::startsSpindle() const {
  return llvm::any_of(outcome_.codes, [&](const CodeUse &use) {
    return info(use).action == Action::SpindleCw || info(use).action == Action::SpindleCcw;
  });
}

/// M06: the tool of the block's T word or of an earlier one.
void Execution::takeTool(const CodeUse &use) {
  if (block_.has(letterAddress('T')) || state_.preselected != notSet) {
    const int32_t tool = state_.preselected.get();
    changeTool(tool != notSet ? tool : notKnown, notSet, *use.word, use.code);
  } else {
    changeTool(state_.tool == notSet ? notKnown : state_.tool.get(), notSet, *use.word, use.code);
  }
  if (info(use).stopsSpindle && !startsSpindle()) {
    if (state_.spindle & (spindleCw | spindleCcw))
      state_.set(Fact::SpindleStoppedByTap);
    state_.spindle = spindleOff;
    state_.origin.set(StatePart::Spindle, originOf(*use.word));
  }
}

/// M61 Q: says which tool is in the spindle; nothing is changed.
void Execution::nameTool(const CodeUse &use) {
  const Word *word = info(use).words.empty() ? nullptr : wordFor(block_, info(use).words.front());
  const Interval number = word ? value(*word) : Interval::unknown();
  state_.tool = number.isConstant() && number.value() >= 0 && number.value() < 1e6
                    ? int32_t(number.value())
                    : notKnown;
  state_.origin.set(StatePart::Tool, originOf(*use.word));
  state_.set(Fact::ToolCalled);
  state_.clear(Fact::LengthSinceTool);
  state_.clear(Fact::CutSinceTool);
  outcome_.setupChanged = true;
}

void Execution::changeTool(int32_t tool, int32_t offset, const Word &word, CodeIndex by) {
  outcome_.setupChanged = true;
  Event &event = outcome_.emit(EventKind::ToolChange);
  event.word = &word;
  event.code = by;
  event.setTool(tool);
  state_.tool = tool;
  if (dialect_.offsetsOfTool)
    state_.lengthOffset = notSet;
  state_.preselected = notSet;
  state_.origin.set(StatePart::Tool, originOf(word));
  state_.set(Fact::ToolCalled);
  state_.clear(Fact::CutSinceTool);
  state_.clear(Fact::MovedSinceTool);
  // `T1 M6 G43 H1`: the tool is changed first, and the offset is that of the new one.
  if (llvm::none_of(outcome_.codes, [&](const CodeUse &use) {
        return info(use).action == Action::LengthPositive ||
               info(use).action == Action::LengthNegative;
      }))
    state_.clear(Fact::LengthSinceTool);
  state_.clear(Fact::OrientedSinceTool);
  state_.clear(Fact::PlungedUncompensated);
  if (dialect_.lengthByTool != noGroup)
    state_.setGroup(dialect_.lengthByTool, groupUnset);
  state_.fedFrom.forget();
  state_.cutArea.clear();
  if (!dialect_.isLathe() && state_.liveTool == spindleAny)
    state_.liveTool = spindleOff; // what another spindle turned was the old tool
  if (dialect_.isLathe()) {
    // Another offset: the same place has other coordinates.
    if (offset != state_.toolOffset || offset == notKnown)
      for (const Axis axis : {Axis::X, Axis::Z})
        if (!state_.inMachineCoordinates(axis))
          state_.at(axis) = Interval::unknown();
    state_.toolOffset = offset;
  }
}

/// A lathe's T word is station and offset (`T0101`); a mill's is a tool, changed at once or by M06.
void Execution::toolWord(const Word &word) {
  outcome_.setupChanged = true;
  const Interval number = value(word);
  Event &event = outcome_.emit(EventKind::ToolWord);
  event.word = &word;
  event.setWordValue(number);
  int32_t tool = notKnown, offset = notKnown;
  if (number.isConstant() && number.value() >= 0 && number.value() < 1e8) {
    const auto whole = int32_t(number.value());
    if (dialect_.isLathe()) {
      constexpr int32_t fiveDigits = 10000;
      const std::optional<double> digits = context_.machine.number("toolOffsetDigits");
      const auto offsets = digits ? int32_t(std::pow(10, *digits)) : 100;
      tool = whole / offsets;
      offset = whole % offsets;
      const bool splitElsewhere = !digits && whole >= fiveDigits && dialect_.facts->tools.anyDigits;
      if ((whole < 100 && !word.has(wordLeadingZero)) || splitElsewhere) {
        // One or two digits name an offset on some controls and a tool on others; where more than
        // four are split is set on the machine.
        tool = notKnown;
        offset = notKnown;
      }
    } else {
      tool = whole;
    }
  }
  if (dialect_.toolChangeByT) {
    if (dialect_.isLathe() && tool == 0) {
      // T0000 and T00 cancel the offset and change nothing.
      state_.toolOffset = 0;
      state_.set(Fact::ToolCalled);
      return;
    }
    if (dialect_.isLathe() && tool == state_.tool && tool != notKnown && offset == 0) {
      state_.toolOffset = 0; // T0100 after T0101: the offset is cancelled
      return;
    }
    changeTool(tool, offset, word, noCode);
    return;
  }
  state_.preselected = tool;
}

} // namespace ncvet
