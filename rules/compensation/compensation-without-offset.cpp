// Compensation without an offset number, or with an offset that holds no radius.
#include "analyzer/facts/corner_words.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/report_once.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/tool_data.h"

namespace ncvet {
namespace {

struct CompensationWithoutOffsetMemory {
  OncePerCause once;
};

class CompensationWithoutOffset final : public StatefulRule<CompensationWithoutOffsetMemory> {
public:
  void listen(Subscriptions &to) override {
    mayChangeByT_ = to.flag("mayChangeByT");
    // A mill whose language has no D takes the radius from elsewhere.
    const Dialect &dialect = to.dialect();
    if (!dialect.isLathe() && !dialect.offsetsOfTool &&
        dialect.addresses[letterAddress('D')].kind == AddressKind::Unknown)
      return;
    to.on(EventKind::CompensationMove);
    to.onAction({Action::CompensationLeft, Action::CompensationRight});
    greatestTip_ = to.dialect().facts->compensation.greatestTip;
    intersects_ = to.dialect().facts->corners.intersects;
    angles_ = cornerAddresses(dialect).angle;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    if (code.action == Action::CompensationOff)
      return;
    // The offset counts when compensation engages; a cycle engages it without a move of its own.
    if (event.kind == EventKind::Code &&
        ((ctx.outcome().kinds & bitOf(EventKind::CompensationMove)) ||
         ctx.after().compensation != phaseOn))
      return;
    check(code, event, ctx);
  }

private:
  /// Whether a T word of the program calls a station.
  static bool callsTool(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block : blocks(ctx.index(), program.body, ctx.block().begin))
      if (const Word *tool = block.find('T'); tool && (!tool->isNumber() || tool->mantissa != 0))
        return true;
    return false;
  }

  /// No offset was called, or the one that cancels them.
  void withoutNumber(int32_t number, const CodeInfo &code, SourceRange where, const Event &event,
                     RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const bool lathe = ctx.dialect().isLathe();
    // Some older controls keep radii in the H table; a form has no tool yet.
    if (state.must(Fact::UnknownCode) ||
        (lathe ? number == 0 && !callsTool(ctx) : ctx.block().has(letterAddress('H'))))
      return;
    // Every contour after one D0 suffers from it; the first says so.
    if (!lathe && number == 0 &&
        (onlyIntersects(ctx) ||
         !memory().once.speaks(state.origin.of(StatePart::RadiusOffset), ctx)))
      return;
    const bool certain = event.certain && !state.may(Fact::UnknownCode);
    auto finding = ctx.report(where, certain);
    if (!finding)
      return;
    if (lathe)
      finding.message(number == 0 ? "`{0}` with the tool offset cancelled: nose radius and tip "
                                    "direction are missing"
                                  : "`{0}` before any tool offset was called: nose radius and tip "
                                    "direction are missing",
                      code.name);
    else
      finding.message(number == 0 ? "`{0}` with D0: the radius is zero, the tool runs on the "
                                    "contour line"
                                  : "`{0}` without a D: the radius is zero, the tool runs on the "
                                    "contour line",
                      code.name);
    finding.note(lathe ? state.origin.of(StatePart::Tool)
                       : state.origin.of(StatePart::RadiusOffset),
                 lathe ? "the tool is called here" : "D is set here");
  }

  void check(const CodeInfo &code, const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const bool lathe = ctx.dialect().isLathe();
    const int32_t number = radiusOffsetNumber(ctx.dialect(), state);
    const CodeUse *use = ctx.find({Action::CompensationLeft, Action::CompensationRight});
    const SourceRange where = use ? ctx.range(*use->word) : ctx.blockRange();
    if (ctx.dialect().offsetsOfTool && number != 0) {
      ofTool(code, where, event, ctx);
      return;
    }
    if (number == notSet || number == 0)
      return withoutNumber(number, code, where, event, ctx);
    if (const ToolData *tool = compensatingTool(ctx.dialect(), ctx.machine(), state);
        lathe && tool && tool->tip && *tool->tip > greatestTip_) {
      if (auto finding = ctx.report(where, event.certain))
        finding.severity(Severity::Warning)
            .message("`{0}` with offset {1}, whose tip direction is {2}: there are directions 0 "
                     "to {3}",
                     code.name, number, *tool->tip, int(greatestTip_))
            .note(state.origin.of(StatePart::Tool), "the tool is called here");
      return;
    }
    if (compensationRadius(ctx.dialect(), ctx.machine(), state) != 0.0)
      return tipOfCentre(code, number, where, event, ctx);
    if (auto finding = ctx.report(where, event.certain))
      finding
          .message("`{0}` with {1} {2}, whose {3} is 0: the tool runs on the contour line",
                   code.name, lathe ? "offset" : "D", number, lathe ? "nose radius" : "radius")
          .note(lathe ? state.origin.of(StatePart::Tool) : state.origin.of(StatePart::RadiusOffset),
                lathe ? "the tool is called here" : "D is set here");
  }

  /// A turning tool's nose that touches the work with one side, and no direction says with which.
  static void tipOfCentre(const CodeInfo &code, int32_t number, SourceRange where,
                          const Event &event, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const ToolData *tool = compensatingTool(ctx.dialect(), ctx.machine(), state);
    const auto radius = compensationRadius(ctx.dialect(), ctx.machine(), state);
    if (!ctx.dialect().isLathe() || !tool || tool->kind != "turning" || !tool->tip || *tool->tip ||
        !radius || *radius <= 0)
      return;
    if (auto finding = ctx.report(where, event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}` with offset {1}, whose tip direction is 0: the control takes the centre "
                   "of the nose for its tip",
                   code.name, number)
          .note(state.origin.of(StatePart::Tool), "the tool is called here");
  }

  /// `G42 G1 X0 Y0 D00`: compensation is on for the points where elements meet, which the control
  /// computes under it alone, and D0 is the way to have no offset there.
  bool onlyIntersects(const RuleContext &ctx) const {
    constexpr unsigned furthest = 50; // blocks
    if (!intersects_ || !ctx.block().has(letterAddress('D')))
      return false;
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest && ahead.next(next); ++i) {
      if (findCode(ctx.dialect(), next, {Action::CompensationOff}))
        return false;
      if (next.hasAny(angles_))
        return true;
    }
    return false;
  }

  /// The program names tools and has no code that changes one in: T itself does it on its machine.
  static bool changesByT(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    bool named = false;
    const auto wants = [&](const TextPiece &piece) {
      return piece.hasAny(maskOf(letterAddress('T'))) ||
             piece.mayName(ctx.dialect(), {Action::ToolChange});
    };
    for (const Block &block : blocksWhere(ctx.index(), program, wants)) {
      if (findCode(ctx.dialect(), block, {Action::ToolChange}))
        return false;
      named |= block.has(letterAddress('T')) && block.begin < ctx.block().begin;
    }
    return named;
  }

  /// The radius comes with the tool, without a number of its own.
  void ofTool(const CodeInfo &code, SourceRange where, const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    // A stock makes a radius of its own, without any tool.
    if (const std::string &stock = ctx.dialect().toolRadius.allowance; !stock.empty()) {
      const uint64_t key = variableKey(stock);
      const Value value = state.commons.get(key);
      if (state.commons.given(key) != Truth::No &&
          !(value.isConstant() && value.number.value() == 0))
        return;
    }
    const bool empty = state.tool == 0;
    const bool none = state.tool == notSet && !state.may(Fact::ToolCalled) &&
                      !state.may(Fact::UnknownCode) && !(mayChangeByT_ && changesByT(ctx));
    // A list of tools is complete, and says the radius of those that have one.
    const ToolData *listed =
        ctx.asked() ? compensatingTool(ctx.dialect(), ctx.machine(), state) : nullptr;
    if (!none && !empty && listed && !listed->radius && !listed->kind.empty() &&
        !compensationRadius(ctx.dialect(), ctx.machine(), state)) {
      if (auto finding = ctx.report(where, event.certain))
        finding.severity(Severity::Warning)
            .message("`{0}` with tool {1}, of which the machine profile gives no radius", code.name,
                     int(state.tool));
      return;
    }
    if (!none && !empty && compensationRadius(ctx.dialect(), ctx.machine(), state) != 0.0)
      return;
    if (auto finding = ctx.report(where, event.certain))
      finding
          .message("`{0}` {1}: the tool runs on the contour line", code.name,
                   empty  ? "with T0: there is no tool"
                   : none ? "before any tool was changed in: the radius is zero"
                          : formatted("with tool {0}, whose radius is 0", int(state.tool)))
          .note(state.origin.of(StatePart::Tool), "the tool is called here");
  }

  double greatestTip_ = 9; ///< of the directions that the control has
  bool intersects_ = false;
  bool mayChangeByT_ = false; ///< on some machines of the control T changes the tool by itself
  AddressMask angles_ = 0;    ///< of lines that are given by their direction
};

} // namespace
NCVET_RULE(CompensationWithoutOffset, compensation_without_offset)
} // namespace ncvet
