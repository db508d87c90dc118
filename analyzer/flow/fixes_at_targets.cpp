// Fixes that put a block before one that something names.
#include "analyzer/flow/fixes_at_targets.h"

namespace ncvet {

namespace {

/// Whether a jump, call or return leads to the block.
bool isTarget(const NamedTargets &named, const FileUnit &unit, const Block &block) {
  if (block.kind == BlockKind::ProgramHeader)
    return !block.isEmpty();
  if (block.number >= 0 && (named.used.anyNumber || named.used.numbers.count(block.number)))
    return true;
  return &unit == &named.unit && block.hasLabel() &&
         named.used.labels.count(
             unit.reader->labelKey(unit.source.text(block.labelBegin, block.labelEnd)));
}

/// Offset of what is executed of a block, after its header, number and label; none: these do not
/// come first, or stand alone, or the block may be skipped.
std::optional<uint32_t> afterHead(const Block &block) {
  if (block.skip >= 0 || block.isEmpty())
    return std::nullopt;
  uint32_t first = block.end;
  for (const Word &word : block.words)
    first = std::min(first, word.offset);
  for (const Item &item : block.items)
    first = std::min(first, item.begin);
  const uint32_t head =
      std::max({block.number >= 0 ? block.numberEnd : 0, block.hasLabel() ? block.labelEnd : 0,
                block.headerEnd, block.nameEnd});
  return head <= first ? std::optional(first) : std::nullopt;
}

/// Whether the edit puts blocks in before the one at its place.
bool insertsLines(const TextEdit &edit) {
  return edit.range.begin == edit.range.end &&
         (llvm::StringRef(edit.text).endswith("\n") || llvm::StringRef(edit.text).endswith("\r"));
}

/// False: the edit cannot be made so that a jump to its place comes by it.
bool keepTargetFirst(const NamedTargets &named, TextEdit &edit) {
  if (!insertsLines(edit))
    return true;
  FileUnit &unit = named.project.unit(named.project.sources().get(edit.range.file));
  Block block;
  unit.reader->read(edit.range.begin, block);
  if (block.begin != edit.range.begin || !isTarget(named, unit, block))
    return true;
  const auto place = afterHead(block);
  if (!place)
    return false;
  edit.range.begin = edit.range.end = *place;
  // Where blocks span lines each begins with its mark: the target's has become the new block's.
  constexpr llvm::StringLiteral mark = "N ";
  if (unit.dialect->lexical.blocksSpanLines && llvm::StringRef(edit.text).startswith(mark))
    edit.text = edit.text.substr(mark.size()) + mark.str();
  return true;
}

} // namespace

void keepTargetsFirst(const NamedTargets &named, std::vector<Finding> &findings) {
  for (Finding &finding : findings)
    if (finding.fix && !llvm::all_of(finding.fix->edits,
                                     [&](TextEdit &edit) { return keepTargetFirst(named, edit); }))
      finding.fix.reset();
}

} // namespace ncvet
