// The tool that was got ready is not the one that the next change brings in.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

struct ToolPreloadMismatchMemory {
  SourceRange ready;    ///< the T that waits for a change, in a block of its own
  int64_t number = -1;  ///< of that tool; -1: it is named by a text
  bool changes = false; ///< the program has changed in a tool: T alone does not
  bool meant = false;   ///< it came with an offset: its change was meant there
};

class ToolPreloadMismatch final : public StatefulRule<ToolPreloadMismatchMemory> {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().toolChangeByT && !to.dialect().isLathe())
      to.on({EventKind::ToolWord, EventKind::ToolChange});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::ToolChange) {
      memory().ready = {};
      memory().changes = true;
    } else if (event.word && !ctx.before().switches.mayBeOn(ctx.dialect().dataSwitches)) {
      named(event, ctx);
    }
  }

private:
  void named(const Event &event, RuleContext &ctx) const {
    const SourceRange before = memory().ready;
    const int64_t number = memory().number;
    const bool meant = memory().meant;
    memory().meant = ctx.block().hasAny(lettersMask("DH")) && !ctx.find({Action::ToolChange});
    memory().ready = ctx.range(*event.word);
    memory().number = numberOf(event);
    if (!before.end || ctx.before().preselected == notSet || ctx.before().may(Fact::UnknownCode) ||
        (!memory().changes && !ctx.find({Action::ToolChange})) ||
        isSame(before, number, event, ctx))
      return;
    if (auto finding = ctx.report(*event.word, event.certain))
      finding.severity(meant ? std::optional(Severity::Warning) : std::nullopt)
          .message("`{0}` takes the place of `{1}`, which was got ready and is never changed in",
                   ctx.text(*event.word), ctx.text(before))
          .note(before, "that tool is got ready here");
  }

  /// Number of the tool; -1 for one that a text names, or that is not known.
  static int64_t numberOf(const Event &event) {
    return event.toolNumber().isConstant() ? int64_t(event.toolNumber().value()) : -1;
  }

  /// Whether it is the tool that waits already, or that cannot be said. T0 empties the place.
  bool isSame(SourceRange before, int64_t number, const Event &event,
              const RuleContext &ctx) const {
    const int64_t next = memory().number;
    if (number >= 0 && next >= 0)
      return number == next || number == 0 || next == 0;
    const llvm::StringRef was = ctx.text(before), is = ctx.text(*event.word);
    return !was.contains('"') || !is.contains('"') || was.equals_insensitive(is);
  }
};

} // namespace
NCVET_RULE(ToolPreloadMismatch, tool_preload_mismatch)
} // namespace ncvet
