// The turning part of what motion-rapid-plunge looks at.
#include "analyzer/facts/turning_rapids.h"

#include "analyzer/facts/length_text.h"
#include "analyzer/facts/next_station.h"
#include "analyzer/facts/rapid_to_chuck.h"
#include "analyzer/facts/turned_pass.h"
#include "formats/text/number_text.h"

namespace ncvet {

bool takesWordsItself(const RuleContext &ctx) {
  return llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
    const CodeInfo &code = ctx.code(use);
    return code.cycle != CycleKind::None || code.action == Action::MachineSpecific;
  });
}

/// A turning tool comes at rapid from outside to below what is left of the work.
void TurningRapids::intoTurned(const Event &event, RuleContext &ctx) const {
  const Interval &from = ctx.before().at(Axis::X), &to = ctx.after().at(Axis::X);
  const bool along = event.axes == 1u << unsigned(Axis::Z);
  if (!(along || event.axes >> unsigned(Axis::X) & 1) || !from.isConstant() || !to.isConstant() ||
      (along ? ctx.after().at(Axis::Z).hi >= ctx.before().at(Axis::Z).lo
             : to.value() >= from.value()) ||
      !event.certain || event.inMachineCoordinates() || takesWordsItself(ctx) ||
      ctx.before().profile != ProfileMode::Off)
    return;
  const auto left = along ? rapidPassInTurned(shapes_, ctx) : rapidIntoTurned(shapes_, ctx);
  if (auto finding = left ? ctx.report(event) : FindingBuilder())
    finding.message("this rapid move ends inside of the diameter {0}, which the program leaves",
                    shortNumber(*left));
}

void TurningRapids::onAxis(const Event &event, const PlacesOfPrograms &places,
                           RuleContext &ctx) const {
  const auto slip = rapidToChuck(shapes_, places, event, ctx);
  if (auto finding = slip ? ctx.report(event) : FindingBuilder())
    finding.message(slip->what, shortLength(ctx, slip->length));
}

/// A lathe: after a pass along the work straight to the begin of a deeper one, through what was
/// just turned: Z first, and then X.
void TurningRapids::throughTurned(const Event &event, RuleContext &ctx) {
  const auto crossed = crossedPass(event, ctx);
  if (!crossed)
    return;
  if (auto finding = ctx.report(event))
    finding.message(crossed->what, shortNumber(crossed->pass.diameter), shortNumber(crossed->at))
        .note(crossed->pass.range, "this cut leaves it");
}

void TurningRapids::towardsChuck(const Event &event, RuleContext &ctx) {
  constexpr uint16_t both = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z);
  const Interval &to = ctx.after().at(Axis::Z);
  const Word *const x = ctx.block().find(letterAddress('X'));
  const Word *const z = ctx.block().find(letterAddress('Z'));
  if (event.axes != both || !to.isConstant() || to.value() >= 0 || !x || !z || !x->isNumber() ||
      !z->isNumber() || z->value() >= 0 || !event.certain || event.inMachineCoordinates() ||
      ctx.before().profile != ProfileMode::Off || nextStation(ctx) != Station::Home)
    return;
  if (!mirrorsOthers(ctx, x->value(), z->value()))
    return;
  if (auto finding = ctx.report(event))
    finding.message("`{0}` leads to the chuck: elsewhere the program goes to X{1} Z{2} before it "
                    "changes the tool",
                    ctx.text(*z), shortNumber(x->value()), shortNumber(-z->value()));
}

void TurningRapids::alongWork(const Event &event, bool &feedsRapids, RuleContext &ctx) {
  const Interval &from = ctx.before().at(Axis::Z), &to = ctx.after().at(Axis::Z);
  if (!ctx.block().has(letterAddress('F')))
    return;
  if (event.axes != 1u << unsigned(Axis::Z) || !event.certain || event.inMachineCoordinates() ||
      !from.isConstant() || !to.isConstant() || to.value() >= from.value() || to.value() >= 0 ||
      ctx.before().inMachineCoordinates(Axis::Z) || ctx.before().may(Fact::UnknownCode) ||
      takesWordsItself(ctx) || !ctx.find({Action::Rapid}) || !retractsNext(ctx)) {
    feedsRapids = true;
    return;
  }
  if (feedsRapids)
    return;
  if (auto finding = ctx.report(event))
    finding.message("this rapid move along the work has a feed, and the tool retracts after it: "
                    "it is not fed, it goes through at full speed");
}

} // namespace ncvet
