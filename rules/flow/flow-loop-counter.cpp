// The variable of a counting loop is written inside the loop.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowLoopCounter final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Statement); }

  void on(const Event &event, RuleContext &ctx) override {
    const Item &item = ctx.block().items[size_t(event.number)];
    counts_ |= item.kind == ItemKind::Structure && item.structure == Structure::For;
  }

  void finish(const FileSummary &file, RuleContext &ctx) override {
    if (!counts_)
      return;
    struct Loop {
      uint64_t variable;
      SourceRange where;
    };
    std::vector<Loop> loops;
    Block block;
    for (uint32_t at = file.reader.first(); at < file.source.text().size(); at = block.next) {
      file.reader.read(at, block);
      for (const Item &item : block.items) {
        if (item.kind == ItemKind::Structure && item.structure == Structure::For) {
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
  static void report(SourceRange range, SourceRange loop, RuleContext &ctx) {
    if (auto finding = ctx.report(range))
      finding
          .message("`{0}` writes the variable that counts the loop: it runs another number of "
                   "times than its head says",
                   ctx.text(range))
          .note(loop, "the loop counts it");
  }

  bool counts_ = false;
};

} // namespace
NCVET_RULE(FlowLoopCounter, flow_loop_counter)
} // namespace ncvet
