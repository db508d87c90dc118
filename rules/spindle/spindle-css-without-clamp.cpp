// Constant surface speed without a limit of the spindle's speed.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/rule.h"
#include "analyzer/rule/text_answers.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class SpindleCssWithoutClamp final : public Rule {
public:
  void listen(Subscriptions &to) override {
    // A control that has no such limit cannot be asked for one.
    const CodeInfo *const limit = firstCodeWith(to.dialect(), Action::SpeedLimit);
    limit_ = limit ? limit->name : "";
    limitFollows_ = to.flag("limitFollows");
    for (const std::string &name : to.dialect().facts->spindle.limitVariables)
      variables_.push_back(variableKey(name));
    if (!limit_.empty() || to.dialect().speedLimitWords)
      to.onAction({Action::SurfaceSpeed, Action::SpeedLimit});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (ctx.code(event).action == Action::SpeedLimit)
      return limitAlone(event, ctx);
    const MachineState &state = ctx.after();
    if (state.must(Fact::SpeedLimitSet) ||
        (state.may(Fact::SpeedLimitSet) && state.may(Fact::UnknownCode)))
      return;
    for (const uint64_t variable : variables_)
      if (state.commons.given(variable) != Truth::No)
        return;
    // Reported where the mode is switched on, not where it is said again.
    if (ctx.before().activeAction(ctx.dialect(), StandardGroup::SpeedMode) == Action::SurfaceSpeed)
      return;
    if (limitFollows_ && comesAtOnce(ctx))
      return;
    const bool certain = !state.may(Fact::SpeedLimitSet) && !state.may(Fact::UnknownCode);
    if (auto finding = ctx.report(event, certain)) {
      finding.severity(severityOf(ctx));
      finding.message(
          "`{0}` without a speed limit: near the centre the spindle runs up to its maximum",
          ctx.code(event).name);
      if (const auto most = ctx.machine().spindleMax; most && !limit_.empty()) {
        const std::string block = formatted("{0} S{1:f0}", limit_, *most);
        finding.fix(FixSafety::Unsafe, "insert `" + block + "` before this block",
                    ctx.insertBlockBefore(block));
      }
    }
  }

private:
  /// It is worst where a cut leads to the centre, or where the program limits the speed elsewhere;
  /// where all cuts are at diameters that ask for a usual speed it is a remark.
  std::optional<Severity> severityOf(const RuleContext &ctx) const {
    constexpr double centre = 2, usual = 2000; // mm of the diameter; revolutions per minute
    constexpr double pi = 3.14159265358979;
    if (limitFollows_ && isLimitedLater(ctx))
      return Severity::Warning;
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    const auto x = ctx.dialect().isLathe() ? smallestX(ctx) : std::nullopt;
    if (!x || !unit)
      return std::nullopt;
    if (*x <= 0)
      return Severity::Warning;
    const GroupIndex units = ctx.dialect().group(StandardGroup::Units);
    if (units == noGroup || !ctx.after().isStated(units)) // 1.8 may be inches
      return std::nullopt;
    if (*x * *unit <= centre)
      return Severity::Warning;
    // Metres a minute with millimetres, feet a minute with inches.
    const double perTurn = *unit == 1 ? 1000 : 12;
    const Interval &speed = ctx.after().speed.get();
    return speed.isConstant() && speed.value() * perTurn / (pi * *x) <= usual
               ? std::optional(Severity::Style)
               : std::nullopt;
  }

  /// The smallest X of the blocks up to the end of the mode, as far as the text tells it.
  static std::optional<double> smallestX(const RuleContext &ctx) {
    constexpr unsigned furthest = 200; // blocks
    const Dialect &dialect = ctx.dialect();
    std::optional<double> smallest;
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; ahead.next(next); ++i) {
      if (findCode(dialect, next,
                   {Action::ConstantSpeed, Action::SpindleStop, Action::ProgramEnd,
                    Action::ProgramEndRewind}) ||
          next.has(letterAddress('T')))
        return smallest;
      if (i == furthest || !next.items.empty())
        return std::nullopt;
      if (findCode(dialect, next,
                   {Action::ReferenceReturn, Action::MachineMove, Action::PresetPosition}))
        continue;
      const bool cycle = findCode(dialect, next, {Action::Cycle});
      if ((next.has(letterAddress('U')) && !cycle) ||
          findCode(dialect, next, {Action::Incremental, Action::CallProgram, Action::MacroCall}))
        return std::nullopt;
      const Word *const x = next.find(letterAddress('X'));
      if (x && !x->isNumber())
        return std::nullopt;
      if (x)
        smallest = std::min(smallest.value_or(x->value()), std::max(x->value(), 0.0));
    }
    return std::nullopt;
  }

  /// What the text makes of each limit of a program: whether a cutting speed, or a speed of the
  /// spindle, is what S means after it.
  struct Limits {
    std::vector<uint32_t> bare; ///< blocks of limits after which S is a speed of the spindle unsaid
    unsigned surface = 0;       ///< limits that a cutting speed follows
  };
  TextAnswers<std::pair<FileId, uint32_t>, Limits> limitsOf_; ///< by file and program

  /// A limit that nothing needs: G96 is missing after it, where all other limits of the program
  /// have it.
  void limitAlone(const Event &event, RuleContext &ctx) const {
    if (ctx.before().may(Fact::UnknownCode) || ctx.callDepth() > 0)
      return;
    if (!cutsAtSpeed(ctx))
      return;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    ctx.index().reader(); // the program is looked through, now or before
    const Limits &known =
        limitsOf_.of({ctx.source().id(), program.begin}, [&] { return readLimits(program, ctx); });
    if (known.surface == 0 || known.bare.size() != 1 || known.bare.front() != ctx.block().begin)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.severity(Severity::Warning)
          .message("no constant cutting speed comes after this limit, as after the others of the "
                   "program: the S that follows it is a speed of the spindle");
  }

  /// Whether a cut follows at an S of the spindle, before another limit or a mode of the speed:
  /// what the others of the program do need not be known else.
  static bool cutsAtSpeed(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    bool speed = false;
    for (const Block &block : blocks(ctx.index().reader(), ctx.block().end, program.end)) {
      if (limits(block, ctx) ||
          findCode(ctx.dialect(), block, {Action::SurfaceSpeed, Action::ConstantSpeed}))
        return false;
      speed |= block.has(letterAddress('S'));
      if (speed && cuts(block, ctx))
        return true;
    }
    return false;
  }

  static bool cuts(const Block &block, const RuleContext &ctx) {
    return findCode(ctx.dialect(), block,
                    {Action::Linear, Action::ArcCw, Action::ArcCcw, Action::Cycle}) != nullptr;
  }

  static Limits readLimits(const ProgramInfo &program, const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    Limits found;
    bool surface = false, open = false, waits = false, speed = false, cut = false;
    uint32_t at = 0;
    const auto close = [&] {
      waits = std::exchange(open, false) && !speed;
      if (speed && cut && !surface)
        found.bare.push_back(at);
      speed = cut = false;
    };
    for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
      if (limits(block, ctx)) {
        close();
        open = true;
        at = block.begin;
        continue;
      }
      if (findCode(dialect, block, {Action::SurfaceSpeed, Action::ConstantSpeed})) {
        close();
        surface = findCode(dialect, block, {Action::SurfaceSpeed}) != nullptr;
        found.surface += surface && waits;
        waits = false;
      }
      speed |= open && block.has(letterAddress('S'));
      cut |= speed && cuts(block, ctx);
    }
    close();
    return found;
  }

  static bool limits(const Block &block, const RuleContext &ctx) {
    return block.has(letterAddress('S')) &&
           findReading(ctx.dialect(), block,
                       [](const CodeInfo &code) { return code.action == Action::SpeedLimit; });
  }

  /// The program limits the speed for one of its later tools: no setting of the machine does it.
  static bool isLimitedLater(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block :
         blocksWith(ctx.index(), program, maskOf(letterAddress('S')), ctx.block().next))
      if (limits(block, ctx))
        return true;
    return false;
  }

  /// The limit is in one of the next blocks, and nothing moves before it.
  static bool comesAtOnce(const RuleContext &ctx) {
    constexpr unsigned furthest = 3; // blocks
    return comesInTime(
        ctx, furthest, [&](const Block &next) { return limits(next, ctx); },
        [&](const Block &next) { return namesAxes(ctx.dialect(), next); });
  }

  std::string limit_;
  bool limitFollows_ = false;                ///< the limit may come in one of the next blocks
  llvm::SmallVector<uint64_t, 2> variables_; ///< keys of those that hold a limit
};

} // namespace
NCVET_RULE(SpindleCssWithoutClamp, spindle_css_without_clamp)
} // namespace ncvet
