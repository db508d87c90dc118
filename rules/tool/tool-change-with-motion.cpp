// A tool change and a move in one block.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ToolChangeWithMotion final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::ToolChange); }

  void on(const Event &event, RuleContext &ctx) const override {
    constexpr uint32_t moves =
        bitOf(EventKind::Motion) | bitOf(EventKind::CycleRun) | bitOf(EventKind::CycleStart);
    if (!(ctx.outcome().kinds & moves) || !axesOf(ctx.dialect(), ctx.block()))
      return;
    // The tool that is in use: at most another offset of it comes.
    if (event.tool() > 0 && ctx.before().tool == event.tool())
      return;
    if (auto finding = ctx.report(event)) {
      const std::string word = ctx.text(*event.word).str();
      finding
          .message("`{0}` is in a block that moves: whether the machine changes or moves "
                   "first is not certain",
                   word)
          .fix(FixSafety::Unsafe, "change the tool in a block of its own, before the move",
               ctx.insertBlockBefore(word))
          .edit(ctx.remove(*event.word));
    }
  }
};

} // namespace
NCVET_RULE(ToolChangeWithMotion, tool_change_with_motion)
} // namespace ncvet
