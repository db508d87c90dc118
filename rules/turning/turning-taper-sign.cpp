// The taper of a turning or threading pass has a doubtful sign.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class TurningTaperSign final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    facing_ = to.dialect().facts->turning.facesCones;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    const bool face = code.cycle == CycleKind::FacePass;
    if (!(face && facing_) && code.cycle != CycleKind::TurnPass &&
        code.cycle != CycleKind::ThreadPass)
      return sleepInShape();
    const Word *word = wordOf(ctx.block(), code, Role::Taper);
    if (!word || word->has(wordNoValue))
      return;
    const Interval taper = ctx.value(*word);
    if (!taper.isConstant() || taper.value() == 0)
      return;
    const Interval &startX = ctx.after().cycleStart[0], &startZ = ctx.after().cycleStart[2];
    const auto u = way(ctx, Axis::X, startX);
    if (!u || *u == 0)
      return;
    bool fits = (taper.value() > 0) == (*u > 0);
    if (face) {
      const auto w = way(ctx, Axis::Z, startZ);
      if (!w || *w == 0)
        return;
      fits = (taper.value() > 0) != (*w > 0);
      if (*u > 0 && *w > 0) // the book's figure leaves this quadrant open
        return;
    }
    if (fits)
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding.message(
          face ? "`{0}` of `{1}`: the cone opens the other way than the pass runs"
               : "`{0}` of `{1}` has another sign than the infeed in X: the cone narrows away "
                 "from the start",
          ctx.text(*word), code.name);
  }

private:
  /// Way from the start along an axis: an increment says it even when the start is not known.
  static std::optional<double> way(RuleContext &ctx, Axis axis, const Interval &start) {
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if (address.axis == axis && address.kind == AddressKind::Increment && word.isNumber())
        return word.value();
    }
    const auto end = endOf(ctx, axis, start);
    if (!end || !start.isConstant())
      return std::nullopt;
    return *end - start.value();
  }

  bool facing_ = false;
};

} // namespace
NCVET_RULE(TurningTaperSign, turning_taper_sign)
} // namespace ncvet
