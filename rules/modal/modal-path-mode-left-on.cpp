// Exact stop or a limit of look-ahead is still on at the end of the program, or over a contour.
#include "analyzer/rule/switch_left_on.h"

#include <map>
#include <set>

namespace ncvet {
namespace {

struct ModalPathModeLeftOnMemory {
  std::map<std::pair<FileId, uint32_t>, std::set<uint32_t>> moves; ///< by where it is switched on
};

class ModalPathModeLeftOn final : public StatefulRule<ModalPathModeLeftOnMemory, LeftOnRule> {
public:
  ModalPathModeLeftOn() : StatefulRule("modal-path-mode-left-on") {}

  void listen(Subscriptions &to) override {
    LeftOnRule::listen(to);
    if (to.flag("overContour"))
      to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Motion)
      return overContour(event, ctx);
    LeftOnRule::on(event, ctx);
  }

private:
  /// An exact stop that the program has switched on stops at every block of the contour.
  void overContour(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    if (event.motion == MotionKind::Rapid || event.motion == MotionKind::Reference ||
        !(event.axes & planeAxes(ctx.dialect(), state)) ||
        state.isActive(ctx.dialect(), StandardGroup::PathMode, {Action::ExactStop}) != Truth::Yes)
      return;
    const Origin origin = state.originOf(ctx.dialect(), StandardGroup::PathMode);
    if (!origin.known())
      return;
    std::set<uint32_t> &moves = memory().moves[{origin.file, origin.begin}];
    if (moves.size() == contour || !moves.insert(ctx.block().begin).second ||
        moves.size() < contour)
      return;
    if (auto finding = ctx.report(origin.range()))
      finding.severity(Severity::Style)
          .message("`{0}` stays on over a contour: the tool stops at the end of every block and "
                   "leaves marks; a stop in one block only is a code of its own",
                   ctx.text(origin.range()))
          .note(ctx.blockRange(), "the contour is cut here");
  }

  /// Blocks in the plane that make a contour; of a run of blocks for the same axes the first
  /// counts.
  static constexpr size_t contour = 4;
};

} // namespace
NCVET_RULE(ModalPathModeLeftOn, modal_path_mode_left_on)
} // namespace ncvet
