// Two codes of one block that exclude each other.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

/// Codes that send control somewhere else or hold it: a block has one next block.
bool leadsElsewhere(Action action) {
  switch (action) {
  case Action::ProgramStop:
  case Action::OptionalStop:
  case Action::ProgramEnd:
  case Action::ProgramEndRewind:
  case Action::ConditionalJump:
  case Action::CallProgram:
  case Action::CallLocal:
  case Action::Return:
    return true;
  default:
    return false;
  }
}

class BlockModalGroupConflict final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    sameTwice_ = to.dialect().facts->program.sameCodeTwiceStops;
    for (const CodeInfo &code : to.dialect().codes)
      setsOneMode_.push_back(setsOneMode(code));
    to.onCode([&](const CodeInfo &code) {
      return sameTwice_ || code.group != noGroup || code.exclusive || leadsElsewhere(code.action) ||
             code.opposite != noCode || isArc(code.action) || takesBack(to.dialect(), code) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    ctx.reportNotices(id, event);
    // What follows looks at the codes alone.
    if (!asksNumbers(ctx.code(event), id))
      sleepInShape();
    if (ctx.codes().size() < 2)
      return;
    const CodeInfo &code = ctx.code(event);
    for (const CodeUse &use : ctx.codes()) {
      if (use.word->offset >= event.word->offset) // the later one of a pair reports
        return;
      const CodeInfo &other = ctx.code(use);
      if (setsOneMode_[event.code] && setsOneMode_[use.code] && code.group != other.group)
        continue;
      // `G00 G81`: the cycle comes last, and drills.
      if (ctx.dialect().facts->cycles.lastCodeCounts && isMotion(other.action) &&
          isModalCycle(ctx.dialect(), code))
        continue;
      if (isFeedBesideSpeed(other, code) || isFeedBesideSpeed(code, other))
        continue;
      const char *why = conflict(ctx.dialect(), other, code, sameTwice_);
      if (!why)
        continue;
      const Word &first = *use.word;
      if (code.group != noGroup && code.group == other.group && isTold(use, event, ctx))
        return;
      if (auto finding = ctx.report(event)) {
        finding.message(!sameTwice_ && ctx.find({Action::ReferenceReturn}) &&
                                decidesPlaces(other, ctx)
                            ? code.action == Action::Absolute ? wayByPlaces : wayByDistances
                            : why,
                        ctx.text(first), ctx.text(*event.word));
        finding.note(ctx.range(first), "the first of the two");
        if (goesHomeEitherWay(other, code, ctx))
          finding.severity(Severity::Style);
        // `G91 G28 Z0 G90`: without its first code the block goes to another place.
        if (!decidesPlaces(other, ctx))
          finding.fix(FixSafety::Unsafe, "delete the first of the two codes", ctx.remove(first));
      }
      return;
    }
  }

private:
  static constexpr llvm::StringLiteral id{"block-modal-group-conflict"};
  static constexpr const char *wayByPlaces =
      "`{0}` and `{1}` belong to one group, and the later one counts: the way home leads over the "
      "coordinates of this block as a place of the work";
  static constexpr const char *wayByDistances = "`{0}` and `{1}` belong to one group, and the "
                                                "later one counts: the coordinates of this block "
                                                "are distances on the way home";

  /// `G28 G53 B0.`, as a post-processor writes it: whichever counts, the axes go to places of the
  /// machine.
  static bool goesHomeEitherWay(const CodeInfo &a, const CodeInfo &b, const RuleContext &ctx) {
    const auto isHome = [](const CodeInfo &code) {
      return code.action == Action::ReferenceReturn || code.action == Action::MachineMove;
    };
    return isHome(a) && isHome(b) && llvm::all_of(ctx.block().words, [&](const Word &word) {
             return !(ctx.dialect().axisWords & maskOf(word.address)) ||
                    (word.isNumber() && word.mantissa == 0);
           });
  }

  /// The code says how the axis words of its block count.
  static bool decidesPlaces(const CodeInfo &code, const RuleContext &ctx) {
    return (code.action == Action::Absolute || code.action == Action::Incremental) &&
           ctx.block().hasAny(ctx.dialect().axisWords);
  }

  /// Whether a code between the two has told of the group already: `M3 M4 M5` has one cause.
  bool isTold(const CodeUse &first, const Event &event, const RuleContext &ctx) const {
    return llvm::any_of(ctx.codes(), [&](const CodeUse &between) {
      return between.word->offset > first.word->offset &&
             between.word->offset < event.word->offset &&
             ctx.code(between).group == ctx.code(first).group &&
             conflict(ctx.dialect(), ctx.code(first), ctx.code(between), sameTwice_);
    });
  }

  /// `G95 G96`, `G94 G97`, where they are of one group: the code of the speed has a unit of the
  /// feed itself, or leaves it as it is.
  static bool isFeedBesideSpeed(const CodeInfo &feed, const CodeInfo &speed) {
    const bool perMinute = feed.action == Action::FeedPerMinute;
    return feed.group == speed.group &&
           ((feed.action == Action::FeedPerRevolution && speed.action == Action::SurfaceSpeed) ||
            ((perMinute || feed.action == Action::FeedPerRevolution) &&
             speed.action == Action::ConstantSpeed));
  }

  /// Whether the code does nothing but become the active one of its group: then it excludes only
  /// other codes of the group.
  static bool setsOneMode(const CodeInfo &code) {
    return code.letter == 'G' && code.group != noGroup && !code.exclusive &&
           !leadsElsewhere(code.action) && !isMotion(code.action) && !isArc(code.action) &&
           code.action != Action::Cycle && code.action != Action::CoolantOn &&
           code.action != Action::CoolantOff && code.action != Action::SpindleStop &&
           !code.stopsSpindle && code.effect.index == 0xFF;
  }

  /// Message of the conflict, or null.
  static const char *conflict(const Dialect &dialect, const CodeInfo &a, const CodeInfo &b,
                              bool sameTwice) {
    // The same code twice says the same thing; a word that is a code has no number.
    if (a.base == b.base || (a.letter && a.letter == b.letter && a.number == b.number)) // the same
      return sameTwice && a.action != Action::CycleCancel
                 ? "`{0}` and `{1}`: the interpreter takes one code of a "
                   "group, and stops at a second one"
                 : nullptr;
    // An oriented stop that is a stop as well: a plain one beside it takes nothing back.
    if ((a.action == Action::SpindleStop && b.stopsSpindle) ||
        (a.stopsSpindle && b.action == Action::SpindleStop))
      return nullptr;
    // The cancel of one family of cycles says nothing of the others.
    if (a.family != b.family &&
        (a.action == Action::CycleCancel || b.action == Action::CycleCancel))
      return nullptr;
    if (a.group != noGroup && a.group == b.group && dialect.groups[a.group].exclusive)
      return "`{0}` and `{1}` belong to one group: only one of them can be in force";
    // An arc that is a code of the machine counts as one of the group.
    if ((isArc(a.action) && a.group == noGroup && isMotion(b.action)) ||
        (isArc(b.action) && b.group == noGroup && isMotion(a.action)))
      return "`{0}` and `{1}` both say how the block moves";
    if (a.exclusive && b.exclusive)
      return "`{0}` and `{1}` are both actions of their own: a block executes one of them";
    if (leadsElsewhere(a.action) && leadsElsewhere(b.action))
      return "`{0}` and `{1}` both say how the program goes on: a block goes on to one place";
    if ((a.action == Action::CoolantOn && b.action == Action::CoolantOff) ||
        (a.action == Action::CoolantOff && b.action == Action::CoolantOn))
      return "`{0}` and `{1}` switch the same thing on and off";
    // `M10 M11`, `M48 M49`: the table names each as what takes the other back.
    if (a.letter == 'M' && b.letter == 'M' &&
        (isOpposite(dialect, a, b) || isOpposite(dialect, b, a)))
      return "`{0}` and `{1}` take each other back";
    // A code of the spindle may switch the coolant with it.
    if (a.action != b.action && a.group != b.group &&
        ((a.action == Action::CoolantOff && switchesOn(b, a)) ||
         (b.action == Action::CoolantOff && switchesOn(a, b))))
      return "`{0}` and `{1}` switch the coolant on and off";
    // A motion code ends the canned cycle that the same block defines.
    if ((isMotion(a.action) && a.cancelsCycle && isModalCycle(dialect, b)) ||
        (isMotion(b.action) && b.cancelsCycle && isModalCycle(dialect, a)))
      return "`{0}` and `{1}` end each other: a motion code cancels the cycle";
    return nullptr;
  }

  /// An M code that is named as the opposite of another one.
  static bool takesBack(const Dialect &dialect, const CodeInfo &code) {
    return code.letter == 'M' && llvm::any_of(dialect.codes, [&](const CodeInfo &of) {
             return of.letter == 'M' && isOpposite(dialect, of, code);
           });
  }

  static bool isOpposite(const Dialect &dialect, const CodeInfo &of, const CodeInfo &code) {
    return of.opposite != noCode && dialect.codes[of.opposite].base == code.base;
  }

  /// Whether `code` switches on besides its own work what `off` switches off.
  static bool switchesOn(const CodeInfo &code, const CodeInfo &off) {
    return code.effect.on && code.effect.index != 0xFF && code.effect.index == off.effect.index;
  }

  static bool isModalCycle(const Dialect &dialect, const CodeInfo &code) {
    return code.action == Action::Cycle && code.group != noGroup &&
           code.group == dialect.group(StandardGroup::Cycle);
  }

  std::vector<bool> setsOneMode_; ///< by code
  bool sameTwice_ = false;        ///< the control also rejects a code that is there twice
};

} // namespace
NCVET_RULE(BlockModalGroupConflict, block_modal_group_conflict)
} // namespace ncvet
