// Which later block relies on a mode that was changed at one place and not stated again.
#include "analyzer/facts/mode_reliance.h"

#include "formats/readers/table_words.h"

namespace ncvet {

namespace {

/// Blocks looked at: modes are stated again or used long before that.
constexpr unsigned mostBlocksAhead = 60;

void drop(ModeChanges &changes, const Dialect &dialect, StandardGroup group) {
  if (dialect.group(group) != noGroup)
    changes.groups &= ~(uint64_t(1) << dialect.group(group));
}

/// Calls `visit` with each code of the block; false when one has no table entry.
template <typename Visit>
bool forCodes(const Block &block, const Dialect &dialect, Visit visit) {
  for (const Word &word : block.words) {
    if (dialect.addresses[word.address].kind != AddressKind::Code)
      continue;
    const CodeIndex index =
        word.isNumber() ? dialect.find(char('A' + word.address), word.codeNumber()) : noCode;
    if (index == noCode)
      return false;
    visit(dialect.codes[index]);
  }
  return true;
}

/// Takes out what the block states itself; false where the text does not tell what runs next.
bool restate(ModeChanges &changes, const Block &block, const Dialect &dialect) {
  bool straight = true;
  if (block.has(letterAddress('T')))
    changes.tool = false;
  const bool known = forCodes(block, dialect, [&](const CodeInfo &code) {
    if (namesTarget(code.action) || code.action == Action::ProgramEnd ||
        code.action == Action::ProgramEndRewind)
      straight = false;
    if (code.group != noGroup)
      changes.groups &= ~(uint64_t(1) << code.group);
    // A motion code ends a cycle, a cycle's code replaces the motion.
    if (dialect.cycleSurvivesMotion)
      return;
    if (code.group == dialect.group(StandardGroup::Motion))
      drop(changes, dialect, StandardGroup::Cycle);
    if (code.group == dialect.group(StandardGroup::Cycle))
      drop(changes, dialect, StandardGroup::Motion);
  });
  return known && straight;
}

/// What a block with axis words uses of the changes.
ModeChanges usedBy(const ModeChanges &changes, const Block &block, const Dialect &dialect) {
  ModeChanges used = changes;
  bool rapid = false, special = false;
  forCodes(block, dialect, [&](const CodeInfo &code) {
    rapid |= code.action == Action::Rapid;
    special |= code.action == Action::MachineMove || code.action == Action::ReferenceReturn ||
               code.action == Action::LocalShift || code.action == Action::PresetPosition ||
               code.action == Action::Dwell || code.action == Action::DataInput;
  });
  for (const Word &word : block.words) // `MIRROR X0`: its axis words are of the frame
    if (const CodeIndex index = codeOf(dialect, word); index != noCode)
      special |= dialect.codes[index].action == Action::FrameSet ||
                 dialect.codes[index].action == Action::FrameAdd;
  if (special)
    return {};
  if (rapid) // plane, feed, speed and compensation say nothing to a rapid move
    for (const StandardGroup group :
         {StandardGroup::FeedMode, StandardGroup::SpeedMode, StandardGroup::Plane,
          StandardGroup::Compensation, StandardGroup::Spindle})
      drop(used, dialect, group);
  if (!(block.addresses & dialect.axisWords & ~dialect.incrementWords))
    drop(used, dialect, StandardGroup::Distance);
  return used;
}

} // namespace

uint64_t groupMask(const Dialect &dialect, std::initializer_list<StandardGroup> groups) {
  uint64_t mask = 0;
  for (const StandardGroup group : groups)
    if (dialect.group(group) != noGroup)
      mask |= uint64_t(1) << dialect.group(group);
  return mask;
}

ModeChanges firstReliance(const RuleContext &ctx, ModeChanges changes, SourceRange &user) {
  const Dialect &dialect = ctx.dialect();
  const Reader &reader = ctx.index().reader();
  Block block;
  uint32_t at = ctx.block().next;
  for (unsigned i = 0; i < mostBlocksAhead && at < ctx.source().text().size() && changes.any();
       ++i) {
    reader.read(at, block);
    if (block.next <= at || block.kind == BlockKind::ProgramHeader)
      break;
    at = block.next;
    if (block.isEmpty() || block.skip >= 0)
      continue;
    if (!block.items.empty() || !restate(changes, block, dialect))
      break;
    if (!block.hasAny(dialect.axisWords))
      continue;
    const ModeChanges used = usedBy(changes, block, dialect);
    if (used.any()) {
      user = {ctx.source().id(), block.words.front().offset, block.endOf(block.words.back())};
      return used;
    }
  }
  return {};
}

std::string titleOf(const ModeChanges &changes, const Dialect &dialect) {
  for (unsigned i = 0; i < dialect.groups.size(); ++i)
    if (changes.groups >> i & 1)
      return dialect.groups[i].title;
  return changes.tool ? "tool" : "mode";
}

} // namespace ncvet
