// Compensation with a negative radius, which swaps its sides, and a stock that is left set.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/switch_left_on.h"
#include "interp/evaluate/tool_data.h"

#include <map>

namespace ncvet {
namespace {

struct CompensationRadiusAllowanceMemory {
  /// By switch of a stock: where it was set, and the contour that was made with it first.
  std::map<unsigned, std::pair<TextPlace, TextPlace>> stocks;
};

class CompensationRadiusAllowance final : public StatefulRule<CompensationRadiusAllowanceMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::CompensationMove, EventKind::OffsetWord});
    listenForLeftOn(id, to);
    to.onCode([](const CodeInfo &code) {
      return llvm::any_of(code.words,
                          [](const WordSpec &w) { return w.role == Role::AllowanceX; }) &&
             code.action != Action::Cycle && !code.letter;
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::ProgramEnd || event.kind == EventKind::ToolChange)
      return reportLeftOn(id, event, ctx);
    if (event.kind == EventKind::Code)
      return stock(event, ctx);
    const Dialect &dialect = ctx.dialect();
    const CodeInfo *code = ctx.after().activeCode(dialect, StandardGroup::Compensation);
    if (!code ||
        (code->action != Action::CompensationLeft && code->action != Action::CompensationRight))
      return;
    if (event.kind == EventKind::OffsetWord &&
        ((ctx.outcome().kinds & bitOf(EventKind::CompensationMove)) ||
         event.word->address != letterAddress('D') || ctx.before().compensation != phaseOn))
      return;
    if (ctx.find({Action::CompensationLeft, Action::CompensationRight}) &&
        ctx.before().compensation == phaseOff)
      furtherContour(ctx);
    const auto radius = compensationRadius(dialect, ctx.machine(), ctx.after());
    if (!radius || *radius >= 0)
      return;
    const CodeUse *use = ctx.find({Action::CompensationLeft, Action::CompensationRight});
    const SourceRange where = event.word ? ctx.range(*event.word)
                              : use      ? ctx.range(*use->word)
                                         : ctx.blockRange();
    if (auto finding = ctx.report(where, event.certain)) {
      const bool left = code->action == Action::CompensationLeft;
      finding
          .message(
              "`{0}` with a radius of {1} mm: a negative radius swaps the sides, the tool runs "
              "on the {2} of the contour",
              code->name, *radius, left ? "right" : "left")
          .note(dialect.isLathe() ? ctx.after().origin.of(StatePart::Tool)
                                  : ctx.after().origin.of(StatePart::RadiusOffset),
                dialect.isLathe() ? "the offset is called here" : "the offset is selected here");
    }
  }

private:
  static constexpr llvm::StringLiteral id{"compensation-radius-allowance"};

  /// Another contour than the first one begins while a stock is set.
  void furtherContour(RuleContext &ctx) const {
    const Dialect &dialect = ctx.dialect();
    const TextPlace here{ctx.source().id(), ctx.block().begin};
    for (unsigned i = 0; i < dialect.switches.size() && i < maxSwitches; ++i) {
      if (dialect.switches[i].leftOn != id || !ctx.before().switchMustBeOn(i))
        continue;
      const Origin &origin = ctx.before().origin.ofSwitch(i);
      const TextPlace set{origin.file, origin.begin};
      auto &[known, first] = memory().stocks[i];
      if (known != set) {
        known = set;
        first = here;
      }
      if (first == here) // or the same one once more
        continue;
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.severity(Severity::Warning)
            .message("another contour begins, and {0} of the one before is still set",
                     dialect.switches[i].title)
            .note(origin, "it is set here");
    }
  }

  /// A stock on the contour, and no compensated contour up to the next one or the end.
  static void stock(const Event &event, RuleContext &ctx) {
    const CodeInfo &code = ctx.code(event);
    const auto value = valueOf(ctx, code, Role::AllowanceX);
    if (!value || *value == 0 || ctx.callDepth() > 0 || ctx.codes().size() > 1 ||
        ctx.before().compensation != phaseOff)
      return;
    constexpr unsigned readable = 500;
    BlocksAhead ahead(ctx);
    Block next;
    bool more = ahead.next(next), cuts = false, ended = false, contour = false;
    for (unsigned i = 0; more && i < readable && !contour; ++i, more = ahead.next(next)) {
      for (const Item &item : next.items)
        if (item.kind != ItemKind::Assignment && item.kind != ItemKind::Instruction && !ended)
          return; // what runs next the text does not tell
      for (const CodeIndex index : codesOf(ctx.dialect(), next)) {
        const CodeInfo &other = ctx.dialect().codes[index];
        const bool begins =
            other.action == Action::CompensationLeft || other.action == Action::CompensationRight;
        if (!ended &&
            (begins || other.action == Action::ProfileBegin || other.action == Action::ProfileRun))
          return;
        contour |= begins;
        cuts |= !ended && (other.action == Action::Linear || isArc(other.action));
        ended |= other.base == code.base;
      }
      if (ended && cuts)
        break;
    }
    // Taken back before anything was cut, it may be meant for what comes after only where a contour
    // does.
    if (ended ? !cuts && !contour : !cuts || !ahead.isOver())
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` sets a stock, and no compensated contour follows that leaves it",
                   ctx.text(*event.word));
  }
};

} // namespace
NCVET_RULE(CompensationRadiusAllowance, compensation_radius_allowance)
} // namespace ncvet
