// A section that is repeated ends before it begins, or holds the block that repeats it or an end.
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include <map>

namespace ncvet {
namespace {

struct FlowRepeatBoundsMemory {
  std::map<FileId, std::vector<RepeatedSection>> sections;
};

class FlowRepeatBounds final : public StatefulRule<FlowRepeatBoundsMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::FlowIssue, EventKind::Statement});
    // A return that ends the program before its repeat: nothing follows the repeat then.
    if (to.dialect().facts->program.endCutsRepeats)
      to.onAction({Action::Return, Action::ProgramEnd, Action::ProgramEndRewind, Action::Reset});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return atEnd(event, ctx);
    if (event.kind == EventKind::FlowIssue) {
      if (event.flowIssue() == FlowIssue::RepeatBounds)
        if (auto finding = ctx.report(ctx.flowRange(), event.certain))
          finding.message("`{0}` lies inside the section that it repeats, or the section ends "
                          "before it begins",
                          ctx.text(ctx.flowRange()));
      return;
    }
    const Item &item = ctx.block().items[event.item()];
    if (item.kind != ItemKind::Repeat || !item.single || item.arguments < 2)
      return sleepAtBlock();
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.message("`{0}` repeats the one block of its label: it takes no second one",
                      ctx.text(range));
  }

private:
  void atEnd(const Event &event, RuleContext &ctx) const {
    const uint32_t at = ctx.block().begin;
    if (ctx.block().skip >= 0)
      return;
    const auto [found, fresh] = memory().sections.try_emplace(ctx.source().id());
    if (fresh)
      found->second = repeatedSections(ctx.index());
    for (const RepeatedSection &section : found->second) {
      if (!section.holds(at))
        continue;
      if (auto finding = ctx.report(event))
        finding
            .message("`{0}` is inside a section that is repeated: no pass comes to its end",
                     ctx.text(*event.word))
            .note(ctx.range(section), "the section is repeated here");
      return;
    }
  }
};

} // namespace
NCVET_RULE(FlowRepeatBounds, flow_repeat_bounds)
} // namespace ncvet
