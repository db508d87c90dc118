// What a word is for: looked up in the formats of the codes that may read it.
#include "lsp/features/word_use.h"

#include "interp/evaluate/block_words.h"
#include "interp/execute/execute.h"
#include "interp/state/executed_block.h"
#include "lsp/features/number_text.h"

namespace ncvet::lsp {

namespace {

bool isTime(Role role) { return role == Role::Time || role == Role::Dwell; }

/// Place (from 1) of an argument among those of the block; 0 for other words.
unsigned positionOf(const Block &block, const Word &word) {
  if (word.address != argumentAddress)
    return 0;
  unsigned position = 0;
  for (const Word &other : block.words) {
    position += other.address == argumentAddress;
    if (&other == &word)
      break;
  }
  return position;
}

/// Looks for a word in formats.
struct Search {
  const Block &block;
  const Word &word;
  unsigned position = positionOf(block, word);
  uint64_t variable = variableOf(block, word);

  bool fits(const WordSpec &spec) const {
    if (position)
      return spec.position == position;
    if (variable)
      return spec.variable == variable || spec.orVariable == variable;
    return spec.any & maskOf(word.address);
  }
  const WordSpec *in(const CodeInfo &code) const {
    const WordSpec *found = nullptr;
    for (const WordSpec &spec : code.words)
      if (fits(spec))
        found = &spec; // the last one goes before those of a base table
    return found;
  }
};

bool isCoordinate(const Dialect &dialect, const Word &word) {
  if (word.address >= addressCount)
    return false;
  const AddressKind kind = dialect.addresses[word.address].kind;
  return kind == AddressKind::Axis || kind == AddressKind::Increment;
}

/// The certainly active code of a group; null: none, or it is not certain.
const CodeInfo *activeCode(const Dialect &dialect, const MachineState &state, GroupIndex group) {
  const uint64_t set = group == noGroup ? 0 : state.group(group);
  if (!set || (set & (set - 1)) || set == groupUnset)
    return nullptr;
  for (const CodeIndex member : dialect.groups[group].members)
    if (set == uint64_t(1) << dialect.codes[member].bit)
      return &dialect.codes[member];
  return nullptr;
}

std::optional<EffectiveValue> timeOf(const Dialect &dialect, const Word &word,
                                     const Interval &value) {
  constexpr double millisecondsPerSecond = 1000;
  const bool milliseconds = dialect.dwellInMilliseconds && word.isNumber() && !word.has(wordPoint);
  if (!milliseconds)
    return EffectiveValue{numberText(value.value()) + " s", !word.isNumber()};
  if (value.value() < millisecondsPerSecond)
    return EffectiveValue{numberText(value.value()) + " ms", true};
  return EffectiveValue{numberText(value.value() / millisecondsPerSecond) + " s", true};
}

/// Unit of a feed or speed under the modes in force; empty: not certain.
std::string rateUnit(const ExecutedBlock &executed, AddressUnit unit) {
  const Dialect &dialect = executed.dialect;
  if (unit == AddressUnit::Speed) {
    const Action mode = executed.after.activeAction(dialect, StandardGroup::SpeedMode);
    return mode == Action::SurfaceSpeed ? "m/min" : mode == Action::ConstantSpeed ? "1/min" : "";
  }
  const Action length = executed.after.activeAction(dialect, StandardGroup::Units);
  const std::string of = length == Action::Inch ? "in" : length == Action::Metric ? "mm" : "";
  switch (executed.after.activeAction(dialect, StandardGroup::FeedMode)) {
  case Action::FeedPerMinute:
    return of.empty() ? "per minute" : of + "/min";
  case Action::FeedPerRevolution:
    return of.empty() ? "per revolution" : of + "/rev";
  case Action::FeedInverseTime:
    return "1/min";
  default:
    return {};
  }
}

} // namespace

uint64_t variableOf(const Block &block, const Word &word) {
  if (word.address != variableAddress)
    return 0;
  for (const Item &item : block.items)
    if (item.kind == ItemKind::Assignment && item.begin == word.offset)
      return block.keyOf(item.target);
  return 0;
}

WordUse useOf(const ExecutedBlock &executed, const Word &word) {
  const Dialect &dialect = executed.dialect;
  const Search search{executed.block, word};
  const CodeInfo *taker = nullptr;
  for (const CodeUse &use : executed.outcome.codes) {
    const CodeInfo &code = dialect.codes[use.code];
    if (const WordSpec *spec = search.in(code))
      return {&code, spec};
    if (!taker && !search.position && !search.variable && (code.takes & maskOf(word.address)))
      taker = &code;
  }
  if (taker || search.position)
    return {taker, nullptr};
  for (const StandardGroup which : {StandardGroup::Cycle, StandardGroup::Motion}) {
    const CodeInfo *code = activeCode(dialect, executed.before, dialect.group(which));
    if (!code)
      continue;
    if (const WordSpec *spec = search.in(*code))
      return {code, spec};
    const bool takes =
        which == StandardGroup::Cycle
            ? isCoordinate(dialect, word) && executed.after.cycleActive(dialect) == Truth::Yes
            : (code->takes & maskOf(word.address)) != 0;
    if (!search.variable && takes)
      return {code, nullptr};
  }
  return {};
}

std::optional<EffectiveValue> effectiveValue(const ExecutedBlock &executed, const Word &word,
                                             const WordUse &use) {
  const Dialect &dialect = executed.dialect;
  const Interval written = wordValue(word, executed.block, executed.before);
  if (word.has(wordNoValue) || !written.isConstant())
    return std::nullopt;
  const AddressInfo &address = dialect.addresses[word.address];
  const bool dwells = use.code && use.code->action == Action::Dwell && !use.spec &&
                      address.kind != AddressKind::Code;
  if ((use.spec && isTime(use.spec->role)) || (dwells && dialect.dwellInMilliseconds))
    return timeOf(dialect, word, written);
  const bool computed = word.has(wordExpression);
  EffectiveValue result{numberText(written.value()), computed};
  const bool lead = use.spec && use.spec->role == Role::Lead;
  if (address.unit == AddressUnit::Length) {
    const Interval length =
        lengthOf(word, executed.block, dialect, executed.machine, executed.after);
    if (!length.isConstant())
      return std::nullopt;
    result.text = numberText(length.value()) + " mm";
    const bool increments = executed.machine.option("decimalPoint") == llvm::StringRef("increment");
    result.hidden |= increments && word.isNumber() && !word.has(wordPoint) && written.value() != 0;
    if (address.diameter && address.kind == AddressKind::Axis)
      result.text += " (diameter)";
  } else if (address.unit == AddressUnit::Angle) {
    result.text += "°";
  } else if ((address.unit == AddressUnit::Feed && !lead) || address.unit == AddressUnit::Speed) {
    const std::string unit = rateUnit(executed, address.unit);
    if (!unit.empty())
      result.text += " " + unit;
  }
  return result;
}

struct LoneBlock::Execution {
  Execution(const Dialect &dialect, const MachineProfile &machine, const Executor &executor,
            Block read, const MachineState *state)
      : block(std::move(read)), before(state ? *state : unknownState(dialect)),
        after(before), executed{dialect, machine, block, outcome, before, after} {
    executor.execute(block, before, after, outcome);
  }

  const Block block;
  MachineState before, after;
  Outcome outcome;
  const ExecutedBlock executed;
};

LoneBlock::LoneBlock(const Dialect &dialect, const MachineProfile &machine,
                     const Executor &executor, Block block, const MachineState *before)
    : execution_(std::make_unique<const Execution>(dialect, machine, executor, std::move(block),
                                                   before)) {}

LoneBlock::~LoneBlock() = default;

const Block &LoneBlock::block() const { return execution_->block; }
const ExecutedBlock &LoneBlock::executed() const { return execution_->executed; }

} // namespace ncvet::lsp
