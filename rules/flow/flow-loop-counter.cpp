// The variable of a counting loop is written inside the loop.
#include "analyzer/facts/used_up_loops.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/evaluate/expression.h"

#include <cmath>

namespace ncvet {
namespace {

struct FlowLoopCounterMemory {
  bool counts = false;
  bool repeats = false;
  bool loops = false; ///< there is a WHILE
};

class FlowLoopCounter final : public StatefulRule<FlowLoopCounterMemory> {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Statement); }

  void on(const Event &event, RuleContext &ctx) const override {
    const Item &item = ctx.block().items[event.item()];
    if (item.kind == ItemKind::Structure && item.structure == Structure::For) {
      memory().counts = true;
      realCounter(item, ctx);
    } else {
      sleepAtBlock();
    }
    memory().repeats |= item.kind == ItemKind::Repeat;
    memory().loops |= item.kind == ItemKind::While ||
                      (item.kind == ItemKind::Structure && item.structure == Structure::While);
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (memory().repeats) {
      setAgain(file, ctx);
      for (const RepeatedSection &section : repeatedSections(file.index))
        neverChanges(section, file, ctx);
    }
    if (memory().loops)
      for (const SourceRange &head : usedUpLoops(file, ctx.dialect()))
        if (auto finding = ctx.report(head))
          finding.message("`{0}` runs in the first pass of the loop round it alone: nothing there "
                          "makes its condition true again",
                          ctx.text(head));
    if (!memory().counts)
      return;
    struct Loop {
      uint64_t variable;
      SourceRange where;
    };
    std::vector<Loop> loops;
    for (const Block &block : blocks(file.reader)) {
      for (const Item &item : block.items) {
        if (item.kind == ItemKind::Structure && item.structure == Structure::For) {
          const uint64_t key = block.keyOf(item.target);
          for (const Loop &loop : loops)
            if (key && loop.variable == key)
              report({file.source.id(), item.begin, item.end}, loop.where, ctx);
          loops.push_back(
              {block.keyOf(item.target), {file.source.id(), item.nameBegin, item.nameEnd}});
        } else if (item.kind == ItemKind::Structure && item.structure == Structure::EndFor) {
          if (!loops.empty())
            loops.pop_back();
        } else if (item.kind == ItemKind::Assignment) {
          const uint64_t key = block.keyOf(item.target);
          for (const Loop &loop : loops)
            if (key && loop.variable == key)
              report({file.source.id(), item.begin, item.end}, loop.where, ctx);
        }
      }
    }
  }

private:
  /// A loop adds 1 in each pass: a counter with decimals ends where nobody expects it.
  static void realCounter(const Item &item, RuleContext &ctx) {
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    const Defined *const defined =
        ctx.index().definition(ctx.index().programAt(ctx.block().begin), ctx.text(range).trim());
    if (!defined || defined->kind != ItemKind::Definition || defined->type != VariableType::Real ||
        (!ctx.asked() && !hasDecimals(item.value, ctx) && !hasDecimals(item.limit, ctx)))
      return; // it counts whole passes all the same
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Style)
          .message("`{0}` counts the passes and is a REAL: the loop adds 1 and takes no other step",
                   ctx.text(range))
          .note(ctx.range(*defined), "it is defined here");
  }

  static bool hasDecimals(uint16_t bound, const RuleContext &ctx) {
    const Value value = bound == noExpression ? Value::unknown()
                                              : evaluate(ctx.block(), bound, ctx.before(), nullptr);
    return value.isConstant() && value.number.value() != std::floor(value.number.value());
  }

  /// A block of a repeated section gives a variable its first value, and a later one counts on.
  static void setAgain(const FileSummary &file, RuleContext &ctx) {
    const std::vector<RepeatedSection> sections = repeatedSections(file.index);
    for (const RepeatedSection &section : sections) {
      struct First {
        uint32_t at;
        uint64_t key;
        SourceRange where;
      };
      std::vector<First> firsts;
      for (const Block &block : blocks(file.reader, section.first, section.after)) {
        for (const Item &item : block.items) {
          if (item.kind == ItemKind::Jump) // another loop may count in here
            firsts.clear();
          if (item.kind != ItemKind::Assignment)
            continue;
          const uint64_t key = block.keyOf(item.target);
          if (isConstant(block, item.value)) {
            llvm::erase_if(firsts, [&](const First &f) { return f.key == key; });
            firsts.push_back({block.begin, key, {file.source.id(), item.begin, item.end}});
            continue;
          }
          const auto first = llvm::find_if(firsts, [&](const First &f) { return f.key == key; });
          // An inner repeat that counts on by itself begins after the first value.
          if (first == firsts.end() || !reads(block, item.value, key) ||
              llvm::any_of(sections, [&](const RepeatedSection &inner) {
                return inner.holds(block.begin) && first->at < inner.first;
              }))
            continue;
          if (auto finding = ctx.report(first->where))
            finding
                .message("`{0}` is in the section that is repeated: every pass counts from "
                         "this value again",
                         ctx.text(first->where))
                .note(SourceRange{file.source.id(), item.begin, item.end}, "here it counts on")
                .note(SourceRange{file.source.id(), section.begin, section.end}, "repeated here");
          firsts.erase(first);
        }
      }
    }
  }

  /// A section lays a frame by a counter, and nothing in it counts on.
  static void neverChanges(const RepeatedSection &section, const FileSummary &file,
                           RuleContext &ctx) {
    const CountedFrame frame = countedFrame(file.index, ctx.dialect(), section);
    if (!frame.code)
      return;
    for (const Block &block : blocks(file.reader, section.first, section.after)) {
      for (const Item &item : block.items)
        if (item.kind == ItemKind::Call || item.kind == ItemKind::Jump ||
            (item.kind == ItemKind::Assignment && block.keyOf(item.target) == frame.counter))
          return; // another program, or another way, may count
    }
    if (auto finding = ctx.report(SourceRange{file.source.id(), section.begin, section.end}))
      finding.message("nothing in the section that is repeated counts on what `{0}` counts with: "
                      "every pass makes the same frame",
                      frame.code->name);
  }

  static bool isConstant(const Block &block, uint16_t index) {
    if (index >= block.expressions.size())
      return false;
    const Expression &e = block.expressions[index];
    return !e.bad && block.operations[e.first].op == Op::Number &&
           (e.count == 1 || (e.count == 2 && block.operations[e.first + 1].op == Op::Negate));
  }

  static bool reads(const Block &block, uint16_t index, uint64_t key) {
    if (index >= block.expressions.size())
      return false;
    const Expression &e = block.expressions[index];
    for (uint32_t i = 0; i < e.count; ++i) {
      const ExpressionOp &op = block.operations[e.first + i];
      if (op.op == Op::Variable && uint64_t(op.value) == key)
        return true;
    }
    return false;
  }

  static void report(SourceRange range, SourceRange loop, RuleContext &ctx) {
    if (auto finding = ctx.report(range))
      finding
          .message("`{0}` writes the variable that counts the loop: it runs another number of "
                   "times than its head says",
                   ctx.text(range))
          .note(loop, "the loop counts it");
  }
};

} // namespace
NCVET_RULE(FlowLoopCounter, flow_loop_counter)
} // namespace ncvet
