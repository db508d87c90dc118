// A drilling cycle runs in a plane in which it does not work.
#include "analyzer/facts/lookahead.h"
#include "formats/dialect/control_facts.h"

#include "llvm/ADT/StringExtras.h"

#include <map>
#include <set>

namespace ncvet {
namespace {

struct CyclePlaneOrAxisMemory {
  bool said = false;
};

class CyclePlaneOrAxis final : public StatefulRule<CyclePlaneOrAxisMemory> {
  static constexpr llvm::StringLiteral id = "cycle-plane-or-axis";

public:
  void listen(Subscriptions &to) override {
    // A lathe that drills in a plane of its own; where G18 is the only plane there is no choice.
    const GroupIndex plane = to.dialect().group(StandardGroup::Plane);
    if (to.dialect().isLathe() && plane != noGroup && to.dialect().facts->cycles.drillsUnderG17)
      for (const CodeIndex member : to.dialect().groups[plane].members)
        wanted_ |= to.dialect().codes[member].action == Action::PlaneXY;
    setup_ = to.flag("setup");
    if (wanted_ || setup_)
      to.on(EventKind::CycleStart);
    if (setup_)
      to.on(EventKind::CycleRun);
    stated_ = to.dialect().facts->cycles.planeStatedFirst;
    if (stated_)
      to.on({EventKind::CycleStart, EventKind::CycleRun});
    for (const std::string &name : to.dialect().axisVariables)
      axes_.insert(variableKey(name));
    if (!axes_.empty())
      to.on(EventKind::Statement);
    to.handleNotices();
    // Arcs of the machine's own that work in one plane.
    for (const auto &[name, selects] : to.machine().names("arcMacroPlanes"))
      if (const CodeIndex arc = to.dialect().find(name), of = to.dialect().find(selects);
          arc != noCode && of != noCode)
        planeOf_[arc] = of;
    to.onCode([&](const CodeInfo &code) {
      return planeOf_.count(code.base) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code) {
      ctx.reportNotices(id, event);
      arcInPlane(event, ctx);
      return;
    }
    if (event.kind == EventKind::Statement)
      return axis(ctx.block().items[event.item()], ctx);
    if (setup_)
      prepared(event, ctx);
    if (stated_)
      plane(event, ctx);
    if (!wanted_)
      return;
    if (event.kind != EventKind::CycleStart)
      return;
    const CodeInfo &code = ctx.code(event);
    const MachineState &state = ctx.after();
    if (!makesHole(code.cycle) || state.active(ctx.dialect(), StandardGroup::Plane) == groupUnset ||
        state.isActive(ctx.dialect(), StandardGroup::Plane, {Action::PlaneZX}) != Truth::Yes)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message("`{0}` drills while G18 is active: holes along Z need G17, holes along X G19",
                   code.name)
          .note(state.originOf(ctx.dialect(), StandardGroup::Plane), "G18 is selected here");
  }

private:
  void arcInPlane(const Event &event, RuleContext &ctx) const {
    const auto wanted = planeOf_.find(ctx.code(event).base);
    if (wanted == planeOf_.end())
      return;
    const CodeInfo *plane = ctx.after().activeCode(ctx.dialect(), StandardGroup::Plane);
    if (!plane || plane->base == wanted->second)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.severity(Severity::Error)
          .message("`{0}` is an arc of the plane `{1}`, and `{2}` is active", ctx.code(event).name,
                   ctx.dialect().codes[wanted->second].name, plane->name)
          .note(ctx.after().originOf(ctx.dialect(), StandardGroup::Plane),
                "`" + plane->name + "` becomes active here");
  }

  std::map<CodeIndex, CodeIndex> planeOf_; ///< arcs of one plane, and the code that selects it

  /// A variable that holds the name of an axis, and gets something else.
  void axis(const Item &item, RuleContext &ctx) const {
    if (item.kind != ItemKind::Assignment || item.value == noExpression ||
        !axes_.count(ctx.block().keyOf(item.target)))
      return;
    const Expression &value = ctx.block().expressions[item.value];
    const ExpressionOp &first = ctx.block().operations[value.first];
    const llvm::StringRef text = ctx.text(ctx.range(item)).rtrim("> \t");
    const char letter = text.empty() ? 0 : llvm::toUpper(text.back());
    const bool named =
        value.count == 1 && first.op == Op::Number && first.value >= double(firstNamedVariable);
    if (value.bad || (named && letter >= 'A' && letter <= 'Z' &&
                      ctx.dialect().addresses[letterAddress(letter)].kind == AddressKind::Axis))
      return; // an axis names itself
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.message("`{0}` names no axis: CFX, CFY, CFZ and their like do", ctx.text(range));
  }

  /// A program of the control that works in the plane to a depth that a variable gives it.
  static bool isProgram(const CodeInfo &code) {
    return code.group == noGroup && llvm::any_of(code.words, [](const WordSpec &word) {
             return word.variable && word.role == Role::Depth;
           });
  }

  /// The plane that holds is the control's own choice.
  void plane(const Event &event, RuleContext &ctx) const {
    const GroupIndex group = ctx.dialect().group(StandardGroup::Plane);
    if (group == noGroup || memory().said || event.code == noCode ||
        !(event.kind == EventKind::CycleStart ? ctx.code(event).firesInPlane
                                              : isProgram(ctx.code(event))) ||
        ctx.before().may(Fact::UnknownCode) || (ctx.after().mayBeStated(group)))
      return;
    memory().said = true;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` runs before the program has stated a plane", ctx.code(event).name);
  }

  /// Work offset, plane and dimensions are programmed before the first cycle.
  void prepared(const Event &event, RuleContext &ctx) const {
    if (event.code == noCode || memory().said || ctx.callDepth() > 0 ||
        ctx.before().may(Fact::UnknownCode) || !ctx.block().has(argumentAddress))
      return;
    std::string missing;
    for (const StandardGroup which :
         {StandardGroup::WorkOffset, StandardGroup::Plane, StandardGroup::Distance}) {
      const GroupIndex group = ctx.dialect().group(which);
      if (group == noGroup || (ctx.before().mayBeStated(group)))
        continue;
      missing += missing.empty() ? "" : ", ";
      missing += ctx.dialect().groups[group].title;
    }
    memory().said = true;
    if (missing.empty())
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` runs before the program has stated: {1}", ctx.code(event).name, missing)
          .severity(Severity::Style); // the control's defaults hold
  }

  std::set<uint64_t> axes_; ///< keys of variables that hold an axis
  bool stated_ = false;     ///< the program states the plane before its first cycle
  bool setup_ = false;
  bool wanted_ = false;
};

} // namespace
NCVET_RULE(CyclePlaneOrAxis, cycle_plane_or_axis)
} // namespace ncvet
