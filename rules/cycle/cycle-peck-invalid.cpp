// The pecks of a drilling cycle are missing, not positive, or contradict each other.
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/path_ahead.h"
#include "analyzer/facts/word_checks.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/evaluate/cycle_parameters.h"

namespace ncvet {
namespace {

struct CyclePeckInvalidMemory {
  KeptFaults faults;
};

class CyclePeckInvalid final : public StatefulRule<CyclePeckInvalidMemory> {
  static constexpr llvm::StringLiteral id = "cycle-peck-invalid";

public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    to.on(EventKind::CycleRun);
    to.onCode([](const CodeInfo &code) {
      return code.action == Action::Cycle ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const bool again = event.kind == EventKind::CycleRun;
    if (again && ctx.codeWord(event))
      return;
    const CodeInfo &code = ctx.code(event);
    if (again && !namesRange(ctx.block(), code) && !wordOf(ctx.block(), code, Role::PeckFirst))
      return sleepInShape();
    if (code.action == Action::Cycle) {
      if (!again)
        reportMissingWords(ctx, event, [](const CodeInfo &of, const WordSpec &spec) {
          return topicOfMissing(of, spec) == WordTopic::Peck;
        });
      reportWordRanges(ctx, event, [](const CodeInfo &of, const WordSpec &spec, Breach) {
        return topicOf(of, spec) == WordTopic::Peck;
      });
      reportKeptRanges(ctx, event, memory().faults, [](const CodeInfo &of, const WordSpec &spec) {
        return topicOf(of, spec) == WordTopic::Peck;
      });
      checkOrder(event, code, ctx);
      if (!again)
        checkDepth(event, code, ctx);
      checkSize(event, code, ctx);
    }
    if (!again)
      return ctx.reportNotices(id, event);
    // A later hole that gives a parameter anew.
    if (const Word *word = assignsWordOf(ctx.block(), code)) {
      Event changed = event;
      changed.word = word;
      ctx.reportNotices(id, changed);
    }
  }

private:
  /// A peck deeper than the hole: it is drilled in one stroke.
  static void checkDepth(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    constexpr double least = 5;  // mm: a spot is drilled in one stroke
    constexpr double much = 1.2; // of the hole
    if ((code.cycle != CycleKind::Peck && code.cycle != CycleKind::ChipBreak) ||
        ctx.dialect().isLathe())
      return;
    const Word *const word = wordOf(ctx.block(), code, Role::Peck);
    if (!word || !word->has(wordPoint))
      return;
    const auto peck = valueOf(ctx, code, Role::Peck);
    const auto from = kept(ctx.after(), code, Role::Retract);
    const auto to = kept(ctx.after(), code, Role::Depth);
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    if (!peck || !from || !to || !unit ||
        ctx.after().isActive(ctx.dialect(), StandardGroup::Distance, {Action::Absolute}) !=
            Truth::Yes)
      return;
    const double hole = *from - *to;
    if (hole * *unit < least || *peck < much * hole)
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}` is more than the whole hole: `{1}` drills it in one stroke",
                   ctx.text(*word), code.name);
  }

  /// A lathe's peck that is larger than the whole hole, or one so small that a zero or a point was
  /// lost.
  static void checkSize(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    constexpr double most = 500; // pecks
    const MachineState &state = ctx.after();
    const Word *const word = wordOf(ctx.block(), code, Role::Peck);
    const Word *const depth = wordOf(ctx.block(), code, Role::Depth);
    if (!event.certain || !word || !word->isNumber() || !depth || !depth->isNumber() ||
        !(ctx.dialect().axisWords & maskOf(depth->address)) || depth->has(wordIncremental) ||
        (!ctx.dialect().isLathe() &&
         state.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Absolute}) != Truth::Yes))
      return;
    const auto unit = millimetresPer(ctx.dialect(), state);
    const ExecutedBlock executed = executedBlock(ctx);
    const auto peck = CycleParameters(executed, code).length(Measure::Step, Role::Peck);
    const auto level = kept(state, code, Role::Retract);
    const Interval &start = state.initialLevel;
    if (!unit || !peck || !peck->isConstant() || peck->value() <= 0 ||
        !isWhole(*word, code, ctx.dialect()) || (!level && !start.isConstant()))
      return;
    const double from = level ? *level * *unit : start.value();
    const double whole = from - depth->value() * *unit;
    const bool larger = ctx.dialect().isLathe() && peck->value() > whole;
    if (whole <= 0 || (!larger && whole / peck->value() <= most))
      return;
    if (auto finding = ctx.report(*word)) {
      if (larger)
        finding.severity(Severity::Warning)
            .message("the peck `{0}` of `{1}` is larger than the whole hole: it is drilled in one "
                     "stroke",
                     ctx.text(*word), code.name);
      else
        finding.severity(Severity::Warning)
            .message("the peck `{0}` of `{1}` makes more than {2} strokes of this hole: was a zero "
                     "or a point lost?",
                     ctx.text(*word), code.name, int(most));
    }
  }

  /// The number counts in units of the program, or in increments that the table turns into such.
  static bool isWhole(const Word &word, const CodeInfo &code, const Dialect &dialect) {
    const bool point = word.has(wordPoint);
    return formulaOf(code, Measure::Step) ? !point
                                          : point || !(dialect.pointAdvised & maskOf(word.address));
  }

  /// Shrinking pecks: the reduction and the least peck are smaller than the first one.
  static void checkOrder(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const Word *firstWord = wordOf(ctx.block(), code, Role::PeckFirst);
    const auto first = valueOf(ctx, code, Role::PeckFirst);
    if (!firstWord || !first || *first <= 0)
      return;
    const auto check = [&](Role role, bool mayEqual, const char *what) {
      const Word *word = wordOf(ctx.block(), code, role);
      const auto value = valueOf(ctx, code, role);
      if (!word || !value || *value < *first || (mayEqual && *value == *first))
        return;
      if (auto finding = ctx.report(*word, event.certain))
        finding
            .message("{0} `{1}` is not smaller than the first peck `{2}`: the pecks cannot shrink",
                     what, ctx.text(*word), ctx.text(*firstWord))
            .note(ctx.range(*firstWord), "the first peck")
            .severity(Severity::Warning);
    };
    check(Role::PeckStep, false, "the reduction");
    check(Role::PeckLeast, true, "the least peck");
  }
};

} // namespace
NCVET_RULE(CyclePeckInvalid, cycle_peck_invalid)
} // namespace ncvet
