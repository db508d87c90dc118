// What a program does with each of its tools: what all of them but one do, that one lacks by a
// slip.
#include "analyzer/facts/program_tools.h"

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/wanted_blocks.h"

#include <array>

namespace ncvet {

namespace {

/// One pass over the blocks of a program.
class ToolReader {
public:
  explicit ToolReader(const Dialect &dialect) : dialect_(dialect) {
    for (const CodeInfo &code : dialect.codes)
      if (ToolPart part; noteSpindle(code, part) && !llvm::is_contained(always_, code.action))
        always_.push_back(code.action);
  }

  /// Whether a block of the piece may say more of the tools than is known.
  bool wants(const TextPiece &piece) const {
    const bool feedIsKnown = tools_.empty() || tools_.back().cutsFirst != FirstCut::None;
    return (dialect_.toolChangeByT && piece.hasAny(maskOf(letterAddress('T')))) ||
           piece.mayName(dialect_, always_) ||
           (!feedIsKnown && piece.hasAny(maskOf(letterAddress('F')))) ||
           ((!cut_ || home_ || !feedIsKnown) && piece.mayName(dialect_, cutting));
  }

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
    if (has(codes, cutting) && !movesOthers(block)) {
      cut_ = true;
      home_ = has(codes, {Action::ReferenceReturn, Action::MachineMove});
    }
    if (tools_.empty())
      return;
    ToolPart &tool = tools_.back();
    for (const CodeIndex code : codes)
      noteSpindle(dialect_.codes[code], tool);
    tool.cuts |= cut_;
    if (tool.cutsFirst == FirstCut::None && (block.has(letterAddress('F')) || has(codes, cutting)))
      tool.cutsFirst = block.has(letterAddress('F')) ? FirstCut::OwnFeed : FirstCut::OtherFeed;
  }

  std::vector<ToolPart> take() { return std::move(tools_); }

private:
  using Codes = llvm::ArrayRef<CodeIndex>;
  static constexpr std::array cutting{Action::Linear, Action::ArcCw, Action::ArcCcw, Action::Cycle};

  bool has(Codes codes, llvm::ArrayRef<Action> actions) const {
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

  /// False: the code says nothing of it.
  static bool noteSpindle(const CodeInfo &code, ToolPart &tool) {
    const bool clockwise = code.action == Action::SpindleCw;
    const bool counterClockwise = code.action == Action::SpindleCcw;
    const bool leftHanded = code.cycle == CycleKind::TapLeft ||
                            code.cycle == CycleKind::RigidTapLeft ||
                            code.spindle == SpindleNeed::CounterClockwise;
    tool.clockwise |= clockwise;
    tool.counterClockwise |= counterClockwise;
    tool.leftHanded |= leftHanded;
    return clockwise || counterClockwise || leftHanded;
  }

  const Dialect &dialect_;
  /// What is looked for whatever is known: changes, ways home, and what the spindle does.
  llvm::SmallVector<Action, 8> always_{Action::ReferenceReturn, Action::MachineMove,
                                       Action::ToolChange};
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
    const auto wants = [&](const TextPiece &piece) { return tools.wants(piece); };
    for (const Block &block : blocksWhere(ctx.index(), program, wants))
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
