// What a program does with each of its tools: what all of them but one do, that one lacks by a
// slip.
#include "analyzer/facts/program_tools.h"

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

namespace ncvet {

namespace {

/// One pass over the blocks of a program.
class ToolReader {
public:
  explicit ToolReader(const Dialect &dialect) : dialect_(dialect) {}

  void read(const Block &block) {
    const auto codes = codesOf(dialect_, block);
    if (has(codes, {Action::ReferenceReturn, Action::MachineMove}))
      home_ = true;
    if (changesTool(block, codes)) {
      ToolPart &tool = tools_.emplace_back();
      tool.begin = block.begin;
      tool.follows = std::exchange(cut_, false);
      tool.home = std::exchange(home_, false);
    }
    if (has(codes, {Action::Linear, Action::ArcCw, Action::ArcCcw, Action::Cycle}) &&
        !movesOthers(block)) {
      cut_ = true;
      home_ = has(codes, {Action::ReferenceReturn, Action::MachineMove});
    }
    if (tools_.empty())
      return;
    ToolPart &tool = tools_.back();
    for (const CodeIndex code : codes)
      noteSpindle(dialect_.codes[code], tool);
    tool.cuts |= cut_;
  }

  std::vector<ToolPart> take() { return std::move(tools_); }

private:
  using Codes = llvm::ArrayRef<CodeIndex>;

  bool has(Codes codes, std::initializer_list<Action> actions) const {
    return llvm::any_of(codes, [&](CodeIndex code) {
      return llvm::is_contained(actions, dialect_.codes[code].action);
    });
  }

  /// On a lathe: another spindle, or a rotary axis, and not the tool.
  bool movesOthers(const Block &block) const {
    constexpr uint16_t ofTool =
        1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y) | 1u << unsigned(Axis::Z);
    const uint16_t axes = axesOf(dialect_, block);
    return dialect_.isLathe() && axes && !(axes & ofTool);
  }

  bool changesTool(const Block &block, Codes codes) const {
    return dialect_.toolChangeByT ? block.has(letterAddress('T'))
                                  : has(codes, {Action::ToolChange});
  }

  static void noteSpindle(const CodeInfo &code, ToolPart &tool) {
    tool.clockwise |= code.action == Action::SpindleCw;
    tool.counterClockwise |= code.action == Action::SpindleCcw;
    tool.leftHanded |= code.cycle == CycleKind::TapLeft || code.cycle == CycleKind::RigidTapLeft ||
                       code.spindle == SpindleNeed::CounterClockwise;
  }

  const Dialect &dialect_;
  std::vector<ToolPart> tools_;
  bool cut_ = false;  ///< the tool in use
  bool home_ = false; ///< it has gone there since
};

} // namespace

llvm::ArrayRef<ToolPart> ProgramTools::of(const RuleContext &ctx) const {
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  ctx.index().reader(); // the program is looked through, now or before
  return known_.of({ctx.source().id(), program.begin}, [&] {
    ToolReader tools(ctx.dialect());
    for (const Block &block : blocks(ctx.index().reader(), program.body, program.end))
      tools.read(block);
    return tools.take();
  });
}

const ToolPart *ProgramTools::inUse(const RuleContext &ctx) const {
  const llvm::ArrayRef<ToolPart> tools = of(ctx);
  const auto *const next = llvm::partition_point(
      tools, [&](const ToolPart &tool) { return tool.begin <= ctx.block().begin; });
  return next == tools.begin() ? nullptr : next - 1;
}

bool ProgramTools::allButOne(const RuleContext &ctx, unsigned habit,
                             llvm::function_ref<bool(const ToolPart &)> counts,
                             llvm::function_ref<bool(const ToolPart &)> is) const {
  unsigned like = 0, other = 0;
  for (const ToolPart &tool : of(ctx))
    if (counts(tool))
      ++(is(tool) ? like : other);
  return like >= habit && other == 1;
}

} // namespace ncvet
