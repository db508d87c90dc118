// Inlay hints: gathered while the program is followed along its one certain path.
#include "lsp/features/showing/inlay_hints.h"

#include "analyzer/flow/engine.h"
#include "interp/evaluate/condition.h"
#include "interp/evaluate/expression.h"
#include "lsp/features/number_text.h"
#include "lsp/features/word_use.h"

#include <map>

namespace ncvet::lsp {

namespace {

/// An editor asks for what it shows; of a larger range the first ones do.
constexpr size_t mostHints = 20000;
/// A block with more words is none that a person reads; looking up each of them would take long.
constexpr size_t mostWords = 300;
/// Blocks executed again before loops are given up: a fraction of a second.
constexpr uint64_t repeatedBlocks = 300'000;

class HintCollector : public FlowListener {
public:
  HintCollector(const Snapshot &snapshot, uint32_t begin, uint32_t end, const HintOptions &options)
      : file_(snapshot.source().id()), begin_(begin), end_(end), options_(options) {}

  FlowInterest interest() const override { return {0, false, true, true}; }

  void executed(const Step &step, bool /*continues*/) override {
    const Block &block = step.block;
    if (step.unit().source.id() != file_ || block.end <= begin_ || block.begin >= end_ ||
        step.outcome.foreign || block.words.size() > mostWords)
      return;
    const ExecutedBlock executed = step.executed();
    for (const Word &word : block.words)
      words(executed, word);
    if (options_.on[size_t(HintKind::Variable)])
      for (const Item &item : block.items)
        assignment(block, item, step.before);
    if (options_.on[size_t(HintKind::Target)])
      target(block, step.outcome);
    if (options_.on[size_t(HintKind::Motion)])
      motion(executed);
  }

  std::vector<InlayHint> hints() const {
    std::vector<InlayHint> all;
    for (const auto &[place, text] : hints_)
      if (!text.empty())
        all.push_back({place.first, place.second, text});
    return all;
  }

private:
  /// A hint that differs from that of an earlier pass holds for none.
  void add(uint32_t offset, HintKind kind, const std::string &text) {
    if (offset < begin_ || offset > end_ || (hints_.size() >= mostHints))
      return;
    const auto [at, isNew] = hints_.try_emplace({offset, kind}, text);
    if (!isNew && at->second != text)
      at->second.clear();
  }

  void words(const ExecutedBlock &executed, const Word &word) {
    const bool computed = word.has(wordExpression);
    const HintKind kind = computed ? HintKind::Variable : HintKind::Value;
    if (!options_.on[size_t(kind)] || word.address == keywordAddress || word.has(wordNoValue) ||
        word.address == variableAddress)
      return;
    const uint32_t end = executed.block.endOf(word);
    if (!computed) {
      if (const auto value = effectiveValue(executed, word, useOf(executed, word));
          value && value->hidden)
        add(end, kind, " " + value->text);
      return;
    }
    if (!isComputed(executed.block, uint16_t(word.mantissa)))
      return;
    const auto value = effectiveValue(executed, word, useOf(executed, word));
    add(end, kind, value ? " = " + value->text : "");
  }

  /// More than one number: its value is not in the text.
  static bool isComputed(const Block &block, uint16_t index) {
    if (index >= block.expressions.size() || block.expressions[index].bad)
      return false;
    for (const ExpressionOp &op : operationsOf(block, block.expressions[index]))
      switch (op.op) {
      case Op::Number:
      case Op::Negate:
        break;
      default:
        return true;
      }
    return false;
  }

  void assignment(const Block &block, const Item &item, const MachineState &before) {
    if (item.kind != ItemKind::Assignment || !isComputed(block, item.value))
      return;
    const Value value = evaluate(block, item.value, before, nullptr);
    add(block.expressions[item.value].end, HintKind::Variable,
        value.isConstant() ? " = " + numberText(value.number.value()) : "");
  }

  void target(const Block &block, const Outcome &outcome) {
    const Flow &flow = outcome.flow;
    if (flow.kind != FlowKind::Jump || flow.item < 0 || size_t(flow.item) >= block.items.size())
      return;
    const Item &item = block.items[size_t(flow.item)];
    if (item.value != noExpression && isComputed(block, item.value))
      add(block.expressions[item.value].end, HintKind::Target,
          flow.target.isConstant() ? " → N" + numberText(flow.target.number.value()) : "");
  }

  /// The code that moves the axes, when the block does not hold it.
  void motion(const ExecutedBlock &executed) {
    const Block &block = executed.block;
    const Word *first = block.findAny(executed.dialect.axisWords | executed.dialect.polarWords);
    if (!first)
      return;
    for (const Event &event : executed.outcome.events) {
      if ((event.kind != EventKind::Motion && event.kind != EventKind::CycleRun) ||
          event.code == noCode)
        continue;
      for (const CodeUse &use : executed.outcome.codes)
        if (use.code == event.code)
          return;
      return add(first->offset, HintKind::Motion, executed.dialect.codes[event.code].name + " ");
    }
  }

  const FileId file_;
  const uint32_t begin_, end_;
  const HintOptions options_;
  std::map<std::pair<uint32_t, HintKind>, std::string> hints_; ///< empty text: it is not certain
};

} // namespace

std::vector<InlayHint> inlayHints(Snapshot &snapshot, uint32_t begin, uint32_t end,
                                  const HintOptions &options, const std::atomic<bool> *cancel) {
  AnalysisLimits limits = snapshot.setup().limits;
  limits.repeatedBlocks = std::min(limits.repeatedBlocks, repeatedBlocks);
  HintCollector collector(snapshot, begin, end, options);
  Engine engine(snapshot.project(), snapshot.unit(), limits, cancel);
  engine.listen(collector);
  engine.follow();
  return collector.hints();
}

std::optional<SourceRange> placeOfMotion(const Dialect &dialect, const MachineState &state) {
  if (!state.activeCode(dialect, StandardGroup::Motion))
    return std::nullopt;
  const Origin origin = state.originOf(dialect, StandardGroup::Motion);
  return origin.known() ? std::optional(origin.range()) : std::nullopt;
}

} // namespace ncvet::lsp
