// A mode that the next program does not expect: left on at the end, or, on lathes, the plane that a
// drilling cycle selected.
#include "analyzer/facts/cause_place.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/switch_left_on.h"

#include <set>

namespace ncvet {
namespace {

struct ModalLeftChangedAtEndMemory {
  std::set<std::pair<FileId, uint32_t>> reported;
};

class ModalLeftChangedAtEnd final : public StatefulRule<ModalLeftChangedAtEndMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().isLathe())
      to.onChange({EventKind::Motion, EventKind::CycleRun});
    listenForLeftOn(id, to);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind != EventKind::Motion && event.kind != EventKind::CycleRun)
      return reportLeftOn(id, event, ctx);
    if (event.kind == EventKind::CycleRun &&
        (event.code == noCode || !isTurned(ctx.code(event).cycle) || !event.certain))
      return;
    constexpr uint16_t turning = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z);
    if (event.kind == EventKind::Motion &&
        (event.motion == MotionKind::Rapid || event.motion == MotionKind::Reference ||
         event.motion == MotionKind::Skip))
      return sleepInShape();
    if (!event.axes || (event.axes & ~turning))
      return sleepInShape();
    const MachineState &state = ctx.after();
    const CodeInfo *plane = state.activeCode(ctx.dialect(), StandardGroup::Plane);
    if (!plane || plane->action == Action::PlaneZX || state.liveTool != spindleOff)
      return sleepInShape();
    // The plane was selected in the block of a drilling cycle, or for one.
    const Origin origin = state.originOf(ctx.dialect(), StandardGroup::Plane);
    if (!origin.known() || !origin.range().begin ||
        !memory().reported.insert({origin.file, origin.begin}).second || !drillsAt(origin, ctx))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("turning in the plane of `{0}`: it was selected for drilling and not set back",
                   plane->name)
          .note(origin, "`" + plane->name + "` becomes active here");
  }

private:
  static constexpr llvm::StringLiteral id{"modal-left-changed-at-end"};

  /// Cycles of the main spindle's turning tools, in the plane of X and Z.
  static bool isTurned(CycleKind kind) { return turnsOrFaces(kind) || cutsThread(kind); }

  /// Whether the block of `origin` or one of the next two holds a cycle.
  static bool drillsAt(const Origin &origin, RuleContext &ctx) {
    Block first;
    readBlockOf(ctx, origin, first);
    const FileIndex &index = ctx.indexOf(origin.file);
    const auto end = uint32_t(index.source().text().size());
    for (const Block &block : blocks(index, first.begin, end, 3))
      for (const Word &word : block.words)
        if (word.address == letterAddress('G') && word.isNumber()) {
          const CodeIndex code = ctx.dialect().find('G', word.codeNumber());
          if (code != noCode && ctx.dialect().codes[code].action == Action::Cycle)
            return true;
        }
    return false;
  }
};

} // namespace
NCVET_RULE(ModalLeftChangedAtEnd, modal_left_changed_at_end)
} // namespace ncvet
