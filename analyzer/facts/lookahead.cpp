// Looks at blocks round the current one for rules, and at their words.
#include "analyzer/facts/lookahead.h"

#include "analyzer/program/block_reading.h"
#include "formats/dialect/measure.h"
#include "formats/dialect/stored_names.h"
#include "interp/evaluate/expression.h"

#include <bit>
#include <cmath>

namespace ncvet {

namespace {

bool readFrom(const FileIndex &index, uint32_t offset, uint32_t end, Block &next) {
  while (offset < end) {
    index.read(offset, next);
    if (next.kind == BlockKind::Tape && next.isEmpty())
      return false;
    if (!next.isEmpty())
      return true;
    offset = next.next;
  }
  return false;
}

} // namespace

bool readOn(const FileIndex &index, Block &block) {
  const uint32_t from = block.next;
  return readFrom(index, from, index.programAt(block.begin).end, block);
}

SourceRange wordsRange(FileId file, const Block &block) {
  SourceRange range{file, block.end, block.begin};
  for (const Word &word : block.words) {
    range.begin = std::min(range.begin, word.offset);
    range.end = std::max(range.end, block.endOf(word));
  }
  if (range.begin >= range.end)
    range = {file, block.begin, std::max(block.end, block.begin + 1)};
  return range;
}

namespace {

/// Reads the block with content that is before `at`.
bool readBackFrom(const RuleContext &ctx, uint32_t at, Block &block) {
  const uint32_t first = ctx.index().programAt(at).body, limit = at;
  while (at > first) {
    at = std::max(first, ctx.source().lines().lineBegin(at - 1));
    ctx.index().read(at, block);
    if (!block.isEmpty())
      return block.next <= limit;
  }
  return false;
}

} // namespace

bool readPrevious(const RuleContext &ctx, Block &previous) {
  return readBackFrom(ctx, ctx.block().begin, previous);
}

bool readBack(const RuleContext &ctx, Block &block) {
  return readBackFrom(ctx, block.begin, block);
}

llvm::SmallVector<CodeIndex, 6> codesOf(const Dialect &dialect, const Block &block) {
  llvm::SmallVector<CodeIndex, 6> codes;
  if (!block.hasAny(maskOf('G') | maskOf('M') | maskOf(keywordAddress)))
    return codes;
  for (const Word &word : block.words)
    if (const CodeIndex code = codeOf(dialect, word); code != noCode)
      codes.push_back(code);
  return codes;
}

const CodeInfo *findCode(const Dialect &dialect, const Block &block,
                         std::initializer_list<Action> actions) {
  for (const CodeIndex code : codesOf(dialect, block))
    if (llvm::is_contained(actions, dialect.codes[code].action))
      return &dialect.codes[code];
  return nullptr;
}

const CodeInfo *findReading(const Dialect &dialect, const Block &block,
                            llvm::function_ref<bool(const CodeInfo &)> holds) {
  for (const CodeIndex index : codesOf(dialect, block)) {
    const CodeInfo &code = dialect.codes[index];
    if (holds(code))
      return &code;
    for (const Variant &variant : code.variants)
      if (holds(dialect.codes[variant.code]))
        return &dialect.codes[variant.code];
  }
  return nullptr;
}

bool hasMotionCode(const Dialect &dialect, const Block &block) {
  for (const CodeIndex code : codesOf(dialect, block)) {
    const CodeInfo &info = dialect.codes[code];
    if (isMotion(info.action) || info.action == Action::Cycle)
      return true;
  }
  return false;
}

const Word *wordOf(const Block &block, const CodeInfo &code, Role role) {
  for (const WordSpec &spec : code.words)
    if (spec.role == role)
      if (const Word *word = wordFor(block, spec))
        return word;
  return nullptr;
}

const Word *assignsWordOf(const Block &block, const CodeInfo &code) {
  if (!block.has(variableAddress))
    return nullptr;
  for (const WordSpec &spec : code.words)
    if (const Word *word = spec.variable ? assignmentOf(block, spec.variable) : nullptr)
      return word;
  return nullptr;
}

AddressMask addressesOf(const CodeInfo &code, Role role) {
  AddressMask mask = 0;
  for (const WordSpec &spec : code.words)
    if (spec.role == role)
      mask |= spec.any;
  return mask;
}

std::optional<double> kept(const MachineState &state, const CodeInfo &code, Role role) {
  for (const WordSpec &spec : code.words)
    if (spec.role == role && spec.variable) {
      const Value value = readVariable(state, int64_t(givenVariable(spec, state)));
      return value.isConstant() ? std::optional(value.number.value()) : std::nullopt;
    }
  const CycleWords &words = state.cycle;
  for (const WordSpec &spec : code.words)
    if (spec.role == role && spec.position && spec.position <= words.value.size()) {
      const unsigned place = spec.position - 1;
      if (!(words.present >> place & 1) || std::isnan(words.value[place]))
        return std::nullopt;
      return words.value[place];
    }
  static_assert(letterAddress('A') == 0, "the letters are the lowest bits of masks");
  const auto given = uint32_t(addressesOf(code, role) & words.present);
  if (!given)
    return std::nullopt;
  const double value = words.value[size_t(std::countr_zero(given))];
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::optional<double> valueOf(const RuleContext &ctx, const CodeInfo &code, Role role) {
  const Word *word = wordOf(ctx.block(), code, role);
  if (!word || word->has(wordNoValue))
    return std::nullopt;
  const Interval value = ctx.value(*word);
  if (!value.isConstant())
    return std::nullopt;
  return value.value();
}

std::optional<double> millimetresPer(const Dialect &dialect, const MachineState &state) {
  const GroupIndex group = dialect.group(StandardGroup::Units);
  if (group == noGroup || state.group(group) == groupUnset)
    return 1;
  switch (state.activeAction(dialect, StandardGroup::Units)) {
  case Action::Inch:
    return 25.4;
  case Action::Metric:
    return 1;
  default:
    return std::nullopt;
  }
}

std::optional<double> endOf(const RuleContext &ctx, Axis axis, const Interval &start) {
  const std::optional<double> unit = millimetresPer(ctx.dialect(), ctx.after());
  if (!unit)
    return std::nullopt;
  const Dialect &dialect = ctx.dialect();
  for (const Word &word : ctx.block().words) {
    const AddressInfo &address = dialect.addresses[word.address];
    if (address.axis != axis ||
        (address.kind != AddressKind::Axis && address.kind != AddressKind::Increment))
      continue;
    if (word.has(wordNoValue))
      return std::nullopt;
    const Interval value = ctx.value(word);
    if (!value.isConstant())
      return std::nullopt;
    const bool incremental = address.kind == AddressKind::Increment || word.has(wordIncremental) ||
                             (dialect.group(StandardGroup::Distance) != noGroup &&
                              ctx.after().active(dialect, StandardGroup::Distance) != groupUnset &&
                              ctx.after().isActive(dialect, StandardGroup::Distance,
                                                   {Action::Incremental}) != Truth::No);
    if (!incremental)
      return value.value() * *unit;
    if (!start.isConstant())
      return std::nullopt;
    return start.value() + value.value() * *unit;
  }
  return std::nullopt;
}

bool namesAxesAlone(const Dialect &dialect, const Block &block) {
  return block.hasAny(dialect.incrementWords) && llvm::all_of(block.words, [&](const Word &word) {
           const AddressMask mask = maskOf(word.address);
           return (mask & dialect.incrementWords) ? word.isNumber() && word.mantissa == 0
                                                  : !(mask & dialect.axisWords);
         });
}

bool comesFromBelow(const MachineState &state) {
  return state.commons.given(storedKey(StoredName::Below)) == Truth::Yes;
}

llvm::StringRef verbOf(CycleKind kind) {
  if (taps(kind))
    return "taps";
  if (bores(kind))
    return "bores";
  switch (kind) {
  case CycleKind::TurnPass:
    return "turns";
  case CycleKind::FacePass:
    return "faces";
  case CycleKind::ThreadPass:
  case CycleKind::ThreadMulti:
    return "cuts the thread";
  case CycleKind::Measure:
    return "measures";
  case CycleKind::Face:
  case CycleKind::Contour:
  case CycleKind::Pocket:
  case CycleKind::Slot:
    return "mills";
  default:
    return "drills";
  }
}

/// Whether a block of the text defines the element that the word names.
static bool isDefined(const Word &element, const RuleContext &ctx) {
  const llvm::StringRef name = ctx.text(element), text = ctx.source().text();
  const Dialect &dialect = ctx.dialect();
  Block block;
  for (size_t at = text.find_insensitive(name); at != llvm::StringRef::npos;
       at = text.find_insensitive(name, at + 1)) {
    readBlockAt(ctx.source(), ctx.index().reader(), uint32_t(at), block);
    const Word *defined = findCode(dialect, block, {Action::DefineElement})
                              ? block.findAny(dialect.elementWords)
                              : nullptr;
    if (defined && defined->address == element.address && defined->mantissa == element.mantissa)
      return true;
  }
  return false;
}

const Word *undefinedElement(const RuleContext &ctx) {
  const Block &block = ctx.block();
  // What a called program uses its caller may have defined; main programs open with a mark.
  if (block.words.size() != 1 || !block.items.empty() || ctx.callDepth() > 0 ||
      ctx.before().profile == ProfileMode::Recorded || ctx.before().compensation != phaseOff ||
      ctx.index().tapeMarks().empty())
    return nullptr;
  const Word &word = block.words.front();
  const AddressInfo &address = ctx.dialect().addresses[word.address];
  if (address.kind != AddressKind::Element)
    return nullptr;
  return isDefined(word, ctx) ? nullptr : &word;
}

} // namespace ncvet
