// Reads and writes the variables of programs: their own, those of all programs, and those in which
// the control says what is in force.
#include "interp/evaluate/variable_access.h"

#include "formats/dialect/variable_key.h"
#include "interp/state/zero_point.h"
#include "interp/value/units.h"

#include <algorithm>

namespace ncvet {

namespace {

/// Extended common variables of larger controls.
constexpr int64_t firstExtended = 98000, lastExtended = 98499;

bool isCommon(const MachineState &state, int64_t number) {
  return (number > state.ranges.lastLocal && number <= state.ranges.lastCommon) ||
         (number >= firstExtended && number <= lastExtended) ||
         number >= int64_t(firstSharedVariable);
}

/// Numbered local variables, and the names that the running program has defined.
bool isLocal(const MachineState &state, int64_t number) {
  return (number > 0 && number <= state.ranges.lastLocal) ||
         (number >= int64_t(firstNamedVariable) &&
          (state.ranges.namedLocal || state.locals.given(uint64_t(number)) != Truth::No));
}

/// A coordinate, as the program would write it.
Value asWritten(const MachineState &state, size_t axis, const Interval &place) {
  if (!place.isConstant())
    return Value::unknown();
  const bool isLength = Axis(axis) < Axis::A || Axis(axis) > Axis::C;
  const uint64_t set = state.ranges.units == noGroup ? groupUnset : state.group(state.ranges.units);
  if (!isLength || !(set & state.ranges.inch))
    return Value::of(place.value());
  return set & ~state.ranges.inch ? Value::unknown()
                                  : Value::of(place.value() / millimetresPerInch);
}

/// Coordinate of the tool.
Value coordinateOf(const MachineState &state, size_t axis) {
  return state.machineAxes >> axis & 1 ? Value::unknown()
                                       : asWritten(state, axis, state.position[axis]);
}

/// Coordinate of the tool on the machine.
Value placeOnMachine(const MachineState &state, size_t axis) {
  if (state.machineAxes >> axis & 1)
    return asWritten(state, axis, state.position[axis]);
  Place place = state.position;
  for (size_t i = 0; i < axisCount; ++i)
    if (state.machineAxes >> i & 1)
      place[i] = Interval::unknown();
  return asWritten(state, axis, zeroOf(state.ranges.zeros, state).toMachine(place)[axis]);
}

/// Axis whose coordinate the variable holds; none when it holds something else.
std::optional<size_t> placeOf(const MachineState &state, int64_t number) {
  if (!state.ranges.place)
    return std::nullopt;
  if (const int64_t axis = number - state.ranges.place; axis >= 0 && axis < int64_t(axisCount))
    return size_t(axis);
  if (number < int64_t(firstSharedVariable) || number >= int64_t(firstNamedVariable))
    return std::nullopt;
  static const auto names = [] {
    std::array<int64_t, axisCount> keys{};
    for (size_t i = 0; i < axisCount; ++i)
      keys[i] = int64_t(sharedVariableKey(std::string("_") + "xyzabcuvw"[i]));
    return keys;
  }();
  const auto found = llvm::find(names, number);
  return found == names.end() ? std::nullopt : std::optional(size_t(found - names.begin()));
}

Value constantOf(const Interval &known) {
  return known.isConstant() ? Value::of(known.value()) : Value::unknown();
}

/// Value of a variable of the control that says what is in force; none: it is no such variable.
std::optional<Value> shownIn(const MachineState &state, uint64_t key) {
  const ShownVariables *const all = state.ranges.shown;
  if (!all || all->empty() || key < all->front().key || key > all->back().key ||
      state.commons.given(key) != Truth::No) // (the program wrote to it)
    return std::nullopt;
  const auto byKey = [](const ShownVariable &a, uint64_t b) { return a.key < b; };
  std::optional<Value> shown;
  for (auto at = std::lower_bound(all->begin(), all->end(), key, byKey);
       at != all->end() && at->key == key; ++at) {
    shown = shown ? shown : Value::unknown();
    switch (at->part) {
    case ShownVariable::Part::Tool:
      return state.tool >= 0 ? Value::of(double(state.tool.get())) : Value::unknown();
    case ShownVariable::Part::Feed: // (in another unit it is another number)
      return state.must(Fact::FeedSet) && !state.may(Fact::FeedCarried) ? constantOf(state.feed)
                                                                        : Value::unknown();
    case ShownVariable::Part::Speed:
      return state.must(Fact::SpeedSet) ? constantOf(state.speed) : Value::unknown();
    case ShownVariable::Part::PlaceOnMachine:
      return placeOnMachine(state, size_t(at->value));
    case ShownVariable::Part::Code:
      if (at->group != noGroup && state.group(at->group) == at->member)
        shown = Value::of(at->value);
    }
  }
  return shown;
}

/// A numbered variable of programs that is before all in which the control says something.
bool isPlain(const VariableRanges &ranges, int64_t number) {
  return number > 0 && number <= ranges.lastCommon && (!ranges.place || number < ranges.place) &&
         (!ranges.shown || ranges.shown->empty() || uint64_t(number) < ranges.shown->front().key);
}

} // namespace

Value readVariable(const MachineState &state, int64_t number) {
  if (number == 0)
    return Value::vacant();
  if (isPlain(state.ranges, number)) // by far the most
    return number <= state.ranges.lastLocal ? state.locals.get(uint64_t(number))
                                            : state.commons.get(uint64_t(number));
  if (const auto shown = shownIn(state, uint64_t(number)))
    return *shown;
  if (const auto axis = placeOf(state, number))
    return coordinateOf(state, *axis);
  if (isLocal(state, number))
    return state.locals.get(uint64_t(number));
  if (isCommon(state, number))
    return state.commons.get(uint64_t(number));
  return Value::unknown();
}

bool showsMachine(const MachineState &state, double number) {
  if (!(number >= 0 && number < pastNumbers) || placeOf(state, int64_t(number)))
    return true;
  return state.ranges.shown && llvm::any_of(*state.ranges.shown, [&](const ShownVariable &one) {
           return one.key == uint64_t(number);
         });
}

Truth isUnset(const MachineState &state, double number) {
  if (number < double(firstNamedVariable) || number >= pastNumbers)
    return Truth::No;
  const auto key = uint64_t(number);
  if (state.locals.given(key) != Truth::No)
    return Truth::No;
  return state.commons.given(key) == Truth::No ? Truth::Yes
         : state.commons.givenOnSomePaths(key) ? Truth::Unknown
                                               : Truth::No;
}

bool isUntouched(const MachineState &state, double number) {
  if (!(number >= 1) || showsMachine(state, number))
    return false;
  const auto key = uint64_t(number);
  if (isLocal(state, int64_t(key)))
    return state.locals.given(key) == Truth::No;
  return isCommon(state, int64_t(key)) && state.commons.given(key) == Truth::No;
}

void writeVariable(MachineState &state, int64_t number, const Value &value) {
  if (isLocal(state, number))
    state.locals.set(uint64_t(number), value);
  else if (isCommon(state, number))
    state.commons.set(uint64_t(number), value);
}

uint64_t givenBackKey() {
  static const uint64_t key = sharedVariableKey("_value");
  return key;
}

uint64_t isGivenBackKey() {
  static const uint64_t key = sharedVariableKey("_value_returned");
  return key;
}

} // namespace ncvet
