// What the words of a cycle say, by their roles.
#include "interp/evaluate/cycle_words.h"

#include "formats/dialect/measure.h"
#include "interp/evaluate/block_words.h"
#include "interp/evaluate/expression.h"
#include "interp/state/modes.h"
#include "interp/value/units.h"

#include <cmath>

namespace ncvet {

namespace {

bool isLength(Role role) {
  switch (role) {
  case Role::Dwell:
  case Role::Time:
  case Role::Repeat:
  case Role::PassCount:
  case Role::Method:
  case Role::Angle:
  case Role::StartAngle:
  case Role::ThreadForm:
  case Role::Speed:
  case Role::Feed:
  case Role::Ratio:
    return false;
  default:
    return true;
  }
}
} // namespace

const WordSpec *CycleWordReader::spec(Role role) const {
  const WordSpec *found = nullptr;
  for (const WordSpec &spec : cycle_.words)
    if (spec.role == role && (!found || wordFor(executed_.block, spec)))
      found = &spec;
  return found;
}

bool CycleWordReader::inch() const {
  return executed_.after.activeAction(executed_.dialect, StandardGroup::Units) == Action::Inch;
}

/// A word that the active cycle keeps from an earlier block.
std::optional<Interval> CycleWordReader::kept(unsigned place, bool length) const {
  if (cycle_.twoBlock) // the words kept are those of the parameter block, which mean other things
    return std::nullopt;
  const CycleWords &words = executed_.after.cycle;
  if (place >= words.value.size() || !(words.present >> place & 1))
    return std::nullopt;
  if (std::isnan(words.value[place]))
    return Interval::unknown();
  return Interval::exactly(words.value[place] * (length && inch() ? millimetresPerInch : 1));
}

std::optional<Interval> CycleWordReader::value(const WordSpec &spec) const {
  const bool length = isLength(spec.role);
  if (const Word *word = wordFor(executed_.block, spec)) {
    if (!length || spec.position || spec.variable)
      return assignedWordValue(*word, executed_.block, executed_.after);
    const Interval value =
        lengthOf(*word, executed_.block, executed_.dialect, executed_.machine, executed_.after);
    // An address that is a length in some codes only: D is a depth of cut, or a number of passes.
    const bool scaled = executed_.dialect.addresses[word->address].unit == AddressUnit::Length;
    return scaled || !inch() ? value : value * millimetresPerInch;
  }
  if (spec.variable) {
    for (const uint64_t key : {spec.variable, spec.orVariable})
      if (key && executed_.after.commons.given(key) == Truth::Yes) {
        const Value value = executed_.after.commons.get(key);
        return value.kind == Value::Kind::Number ? value.number : Interval::unknown();
      }
    if (executed_.after.commons.given(spec.variable) == Truth::Unknown)
      return Interval::unknown();
  } else if (spec.position) {
    if (const auto value = kept(spec.position - 1, length))
      return value;
  } else {
    for (unsigned letter = 0; letter < 26; ++letter)
      if (spec.any >> letter & 1)
        if (const auto value = kept(letter, length))
          return value;
  }
  if (spec.absent)
    return Interval::exactly(*spec.absent);
  return std::nullopt;
}

std::optional<Interval> CycleWordReader::value(Role role) const {
  const WordSpec *spec = this->spec(role);
  return spec ? value(*spec) : std::nullopt;
}

bool CycleWordReader::isIncrement(const WordSpec &spec) const {
  if (spec.position || spec.variable)
    return false;
  const auto increments = spec.any & executed_.dialect.incrementWords;
  if (const Word *word = wordFor(executed_.block, spec))
    return maskOf(word->address) & increments || word->has(wordIncremental) ||
           word->reading() == WordReading::Incremental;
  for (unsigned letter = 0; letter < 26; ++letter)
    if (spec.any >> letter & 1 && executed_.after.cycle.present >> letter & 1)
      return increments >> letter & 1;
  return false;
}

bool takesOverWords(const CodeInfo &next, const Dialect &dialect, const MachineState &before) {
  if (!has(next, CycleTrait::KeepsWords))
    return false;
  const auto active = before.candidates(dialect, StandardGroup::Cycle);
  return !active.empty() && !(before.active(dialect, StandardGroup::Cycle) & groupUnset) &&
         llvm::all_of(active,
                      [](const CodeInfo *code) { return has(*code, CycleTrait::KeepsWords); });
}

} // namespace ncvet
