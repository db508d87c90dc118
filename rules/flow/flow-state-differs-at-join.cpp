// A block is reached in different modes, depending on the path.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/expression.h"

#include <map>
#include <set>

namespace ncvet {
namespace {

struct FlowStateDiffersAtJoinMemory {
  struct Seen {
    uint64_t members = 0; ///< that were active; 0: not seen yet
    bool own = false;     ///< this program has set them
  };
  struct Target {
    std::map<GroupIndex, Seen> seen;
    uint64_t frames = 0; ///< hash of the shifts and turns; 0: not seen yet
    bool said = false;
  };
  struct Joint {
    bool leadsBack = false;              ///< control comes to it from a later block
    std::map<TextPlace, Target> callers; ///< by where the program was called
  };
  std::set<FileId> files; ///< those whose targets are known
  std::map<TextPlace, Joint> joints;
};

class FlowStateDiffersAtJoin final : public StatefulRule<FlowStateDiffersAtJoinMemory> {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().facts->program.modesStatedAtTargets)
      return;
    to.on({EventKind::Statement, EventKind::Block});
    for (const StandardGroup which :
         {StandardGroup::Distance, StandardGroup::Plane, StandardGroup::Units,
          StandardGroup::Compensation, StandardGroup::Cycle, StandardGroup::WorkOffset})
      if (const GroupIndex group = to.dialect().group(which); group != noGroup)
        groups_.push_back(group);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement) {
      const Item &item = ctx.block().items[event.item()];
      if (item.kind == ItemKind::Jump && item.nameEnd > item.nameBegin && ctx.callDepth() == 0)
        intoProgram(item, ctx);
      return;
    }
    if (memory().files.insert(ctx.source().id()).second)
      findJoints(ctx);
    if (memory().joints.empty())
      return;
    const auto at = memory().joints.find({ctx.source().id(), ctx.block().begin});
    // Only a block that moves depends on the modes.
    if (at != memory().joints.end() && !ctx.before().may(Fact::UnknownCode) &&
        ctx.block().hasAny(ctx.dialect().axisWords))
      arrive(at->second, ctx);
  }

private:
  /// Where jumps and repeats lead within their program: other ways come in there.
  void findJoints(RuleContext &ctx) const {
    const FileId file = ctx.source().id();
    const auto read = [&](uint32_t from, const Block &block) {
      for (const Item &item : block.items) {
        const bool repeats = item.kind == ItemKind::Repeat;
        if ((item.kind != ItemKind::Jump && item.kind != ItemKind::Input && !repeats) ||
            (item.kind == ItemKind::Jump && item.nameEnd > item.nameBegin))
          continue;
        for (const Argument &argument : block.argumentsOf(item)) {
          if (const auto to = blockNamed(ctx.index(), block, item, argument))
            memory().joints[{file, *to}].leadsBack |= *to <= from;
          if (repeats)
            break;
        }
      }
      return true;
    };
    ctx.index().eachBlock(ctx.index().reader().first(), uint32_t(ctx.source().text().size()), read,
                          [](const TextPiece &) { return true; });
  }

  void arrive(Memory::Joint &joint, RuleContext &ctx) const {
    const CallSite *caller = ctx.caller();
    const bool called = caller && caller->unit;
    const TextPlace from =
        called ? TextPlace{caller->unit->source.id(), caller->next} : TextPlace();
    Memory::Target &here = joint.callers[from];
    if (here.said)
      return;
    const MachineState &state = ctx.before();
    for (const GroupIndex group : groups_) {
      if (joint.leadsBack && group == ctx.dialect().group(StandardGroup::WorkOffset))
        continue; // the passes of a loop work at one origin after the other
      const Memory::Seen now{meaning(group, state.group(group), ctx.dialect()),
                             state.origin.ofGroup(group).file == ctx.source().id()};
      const Memory::Seen was = std::exchange(here.seen[group], now);
      const bool same = !was.members || was.members == now.members;
      // What the block states itself does not count.
      if ((same && !(now.members & (now.members - 1))) ||
          (now.members | was.members) & groupUnset || states(group, ctx) || !uses(group, ctx) ||
          (called && !now.own && !was.own))
        continue;
      here.said = true;
      if (auto finding = ctx.report(ctx.blockRange(), false))
        finding
            .message("this block is reached with different states of {0}, depending on the path",
                     ctx.dialect().groups[group].title)
            .note(state.origin.ofGroup(group), "one of them is set here");
      return;
    }
    frames(here, joint.leadsBack, ctx);
  }

  /// A shift or turn of the coordinates, which the passes of a loop may well add to.
  static void frames(Memory::Target &here, bool leadsBack, RuleContext &ctx) {
    if (leadsBack || ctx.callDepth() > 0)
      return;
    const auto total = ctx.before().frames.total();
    if (!total)
      return;
    // A shift by nothing is none.
    const uint64_t now = *total == Frame() ? 1 : ctx.before().frames.hash() | 2;
    const uint64_t was = std::exchange(here.frames, now);
    if (!was || was == now ||
        ctx.find({Action::FrameSet, Action::FrameAdd, Action::FrameClear, Action::Reset,
                  Action::MachineMove}))
      return;
    here.said = true;
    if (auto finding = ctx.report(ctx.blockRange(), false))
      finding.text("this block is reached with and without a shift or turn of the coordinates, "
                   "depending on the path");
  }

  /// The members with one of each meaning: G17 is the plane of `G16XYZ`, G46 ends what G40 ends.
  static uint64_t meaning(GroupIndex group, uint64_t members, const Dialect &dialect) {
    const GroupInfo &info = dialect.groups[group];
    uint64_t result = members & groupUnset;
    for (size_t i = 0; i < info.members.size(); ++i)
      if (members >> i & 1)
        result |= uint64_t(1) << first(info, dialect.codes[info.members[i]], dialect);
    return result;
  }
  static uint8_t first(const GroupInfo &group, const CodeInfo &code, const Dialect &dialect) {
    const Action action = code.action;
    if (action != Action::PlaneXY && action != Action::PlaneZX && action != Action::PlaneYZ &&
        action != Action::CompensationOff && action != Action::CompensationLeft &&
        action != Action::CompensationRight && action != Action::CycleCancel)
      return code.bit;
    for (const CodeIndex member : group.members)
      if (const CodeInfo &other = dialect.codes[member];
          other.action == action && other.firstAxis == code.firstAxis)
        return other.bit;
    return code.bit;
  }

  /// A jump to a block of another program passes over what that program states before it.
  void intoProgram(const Item &item, RuleContext &ctx) const {
    const Block &block = ctx.block();
    const auto targets = block.argumentsOf(item);
    const llvm::StringRef name = ctx.source().text(item.nameBegin, item.nameEnd);
    if (targets.empty() || targets[0].kind != ArgumentKind::BlockNumber || !ctx.unit().project ||
        ctx.before().may(Fact::UnknownCode))
      return;
    const auto [unit, program] = ctx.unit().project->findProgram(ctx.unit(), name);
    const Value number = evaluate(block, targets[0].expression, ctx.before(), nullptr);
    if (!program || !number.isConstant())
      return;
    const auto target =
        unit->index.block(*program, std::llround(number.number.value()), program->begin);
    if (!target || *target - program->body > longestHead)
      return;
    const Head head = headOf(*unit, *program, *target, ctx);
    Block first;
    unit->index.read(*target, first);
    if (!first.hasAny(ctx.dialect().axisWords))
      return;
    const auto report = [&](const SourceRange &stated, llvm::StringRef what) {
      if (auto finding = ctx.report(ctx.range(item), false))
        finding
            .message("the jump passes over `{0}` of `{1}`, and another state of {2} is in force "
                     "here",
                     ctx.text(stated), name, what)
            .note(stated, "the program states it here, before the block of the jump");
    };
    for (const auto &[group, stated] : head.modes)
      if (passesOver(group, stated.first, first, ctx))
        return report(stated.second, ctx.dialect().groups[group].title);
    const int32_t tool = ctx.before().tool;
    if (head.tool != notSet && tool != notSet && tool != notKnown && tool != head.tool)
      report(head.toolAt, "the tool");
  }

  /// What a program states before one of its blocks.
  struct Head {
    std::map<GroupIndex, std::pair<CodeIndex, SourceRange>> modes;
    int32_t tool = notSet; ///< that it changes to
    SourceRange toolAt;
  };
  Head headOf(FileUnit &unit, const ProgramInfo &program, uint32_t target,
              const RuleContext &ctx) const {
    const Dialect &dialect = ctx.dialect();
    Head head;
    for (const Block &block : blocks(unit.index, program.begin, target)) {
      for (const Word &word : block.words) {
        const CodeIndex index = codeOf(dialect, word);
        if (index == noCode)
          continue;
        const CodeInfo &code = dialect.codes[index];
        const SourceRange range{unit.source.id(), word.offset, block.endOf(word)};
        if (llvm::is_contained(groups_, code.group))
          head.modes[code.group] = {index, range};
        for (const GroupIndex group : groups_)
          if (code.action == Action::Reset && dialect.groups[group].initial != 0xFF)
            head.modes[group] = {dialect.groups[group].members[dialect.groups[group].initial],
                                 range};
        const Word *tool = block.find('T');
        if (code.action == Action::ToolChange && tool && tool->isNumber()) {
          head.tool = int32_t(tool->value());
          head.toolAt = range;
        }
      }
    }
    return head;
  }

  /// Whether another code of the group is in force, and the block relies on it.
  static bool passesOver(GroupIndex group, CodeIndex stated, const Block &block,
                         const RuleContext &ctx) {
    const uint64_t now = meaning(group, ctx.before().group(group), ctx.dialect());
    const CodeInfo &code = ctx.dialect().codes[stated];
    const uint8_t bit =
        code.bit < 64 ? first(ctx.dialect().groups[group], code, ctx.dialect()) : 64;
    const bool restates = llvm::any_of(codesOf(ctx.dialect(), block), [&](CodeIndex index) {
      return ctx.dialect().codes[index].group == group;
    });
    return !restates && !(now & groupUnset) && !(now & (now - 1)) && bit < 64 &&
           now != uint64_t(1) << bit;
  }

  static bool states(GroupIndex group, const RuleContext &ctx) {
    return llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
      return ctx.code(use).group == group || ctx.code(use).action == Action::Reset;
    });
  }

  /// Whether the block, which moves, depends on the mode.
  static bool uses(GroupIndex group, const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    return group != dialect.group(StandardGroup::Distance) ||
           ctx.block().hasAny(dialect.axisWords & ~dialect.incrementWords);
  }

  /// Bytes before the target that are read: what a program states it states at its head.
  static constexpr uint32_t longestHead = 20000;

  std::vector<GroupIndex> groups_;
};

} // namespace
NCVET_RULE(FlowStateDiffersAtJoin, flow_state_differs_at_join)
} // namespace ncvet
