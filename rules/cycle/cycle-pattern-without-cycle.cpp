// Positions for a cycle that does not run.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

class CyclePatternWithoutCycle final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    for (const CodeInfo &code : to.dialect().codes)
      modal_ |= code.waits;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    if (code.cycle == CycleKind::Pattern) {
      const Truth active = ctx.before().cycleActive(ctx.dialect());
      // The block may begin the cycle itself.
      const bool begun = llvm::any_of(codesOf(ctx.dialect(), ctx.block()), [&](CodeIndex other) {
        return makesHole(ctx.dialect().codes[other].cycle);
      });
      if (active == Truth::Yes || begun || ctx.before().modalCalls ||
          ctx.before().may(Fact::UnknownCode))
        return;
      if (auto finding = ctx.report(event, active == Truth::No))
        finding.message("`{0}` moves from place to place, and no modal call runs at any of them",
                        code.name);
      return;
    }
    if (!modal_ || !makesHole(code.cycle) || code.group != noGroup)
      return sleepInShape();
    // In the plane of turning a hole lies on the axis, and the tool goes away after it.
    if (ctx.before().isActive(ctx.dialect(), StandardGroup::Plane, {Action::PlaneZX}) ==
            Truth::No &&
        positionsFollow(ctx))
      if (auto finding = ctx.report(event, event.certain))
        finding.message("`{0}` drills here only: at the positions after it nothing happens without "
                        "a modal call",
                        code.name);
  }

private:
  /// Two blocks and more of nothing but coordinates in the plane, to which the tool goes by rapid.
  /// A further call after them says that each hole has its own.
  static bool positionsFollow(RuleContext &ctx) {
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    BlocksAhead ahead(ctx);
    Block next;
    bool more = ahead.next(next);
    unsigned places = 0;
    for (; more && places < 2; more = ahead.next(next)) {
      const AddressMask polar = ctx.dialect().polarWords;
      const bool plain = !(next.addresses & ~(ctx.dialect().axisWords | polar | maskOf('G')));
      if (!next.items.empty() || next.words.empty() || !plain ||
          llvm::any_of(next.words, [&](const Word &word) {
            const CodeIndex code =
                word.address == letterAddress('G') ? codeOf(ctx.dialect(), word) : noCode;
            return word.address == letterAddress('G') &&
                   (code == noCode || ctx.dialect().codes[code].action != Action::Rapid);
          }))
        break;
      const uint16_t axes = axesOf(ctx.dialect(), next);
      if (axes ? (axes & ~plane) != 0 : !next.hasAny(polar))
        break;
      ++places;
    }
    for (unsigned i = 0; more && places == 2 && i < lookAhead; ++i, more = ahead.next(next)) {
      if (llvm::any_of(codesOf(ctx.dialect(), next),
                       [&](CodeIndex code) { return makesHole(ctx.dialect().codes[code].cycle); }))
        return false;
      if (next.words.empty() || !next.hasAny(ctx.dialect().axisWords | ctx.dialect().polarWords))
        break;
    }
    return places == 2;
  }

  static constexpr unsigned lookAhead = 4; ///< blocks

  bool modal_ = false;
};

} // namespace
NCVET_RULE(CyclePatternWithoutCycle, cycle_pattern_without_cycle)
} // namespace ncvet
