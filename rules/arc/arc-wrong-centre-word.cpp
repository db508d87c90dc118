// An arc block with a centre word of an axis that does not lie in the active plane.
#include "analyzer/once.h"
#include "interp/arc.h"

namespace ncvet {
namespace {

class ArcWrongCentreWord final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw}); }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode)
      return;
    const Dialect &dialect = ctx.dialect();
    const ArcWords words = arcWords(dialect, ctx.after(), ctx.block());
    if (!words.foreign || !words.planeKnown)
      return;
    // A word of value 0 changes nothing, and a post-processor that writes it writes it everywhere.
    const Interval value = ctx.value(*words.foreign);
    if (value.isConstant() && value.value() == 0 && words.centre[0] && words.centre[1] &&
        !once_.speaks(Origin(), ctx))
      return;
    const std::string first = dialect.addressName(words.centreAddress[0]);
    const std::string second = dialect.addressName(words.centreAddress[1]);
    const CodeInfo *plane = ctx.after().activeCode(dialect, StandardGroup::Plane);
    auto finding = ctx.report(*words.foreign, event.certain);
    if (!finding)
      return;
    const std::string where = plane ? "in the plane of `" + plane->name + "`" : "in this plane";
    finding.message("`{0}` does not belong to an arc {1}: its centre words are {2} and {3}",
                    ctx.text(*words.foreign), where, first, second);
    if (plane)
      finding.note(ctx.after().originOf(dialect, StandardGroup::Plane),
                   "`" + plane->name + "` is selected here");
    if (words.centre[0] && words.centre[1]) {
      finding.fix(FixSafety::Unsafe, "remove `" + ctx.text(*words.foreign).str() + "`",
                  ctx.remove(*words.foreign));
    } else if (words.hasCentre()) {
      const std::string &missing = words.centre[0] ? second : first;
      const SourceRange letter{ctx.source().id(), words.foreign->offset, words.foreign->offset + 1};
      finding.fix(FixSafety::Unsafe, "write `" + missing + "` for `" + ctx.text(letter).str() + "`",
                  ctx.replace(letter, missing));
    }
  }

private:
  OncePerCause once_;
};

} // namespace
NCVET_RULE(ArcWrongCentreWord, arc_wrong_centre_word)
} // namespace ncvet
