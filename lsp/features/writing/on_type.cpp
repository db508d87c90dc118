// Edits while typing: the number of a new block, by its neighbours.
#include "lsp/features/writing/on_type.h"

namespace ncvet::lsp {

namespace {

/// Blocks on each side in which numbers are looked for.
constexpr unsigned mostBlocksLooked = 30;
constexpr int64_t usualStep = 10;

/// The numbers beside a line.
struct Neighbours {
  Block last;                  ///< the nearest block before that is not empty
  std::vector<int64_t> before; ///< numbers before, the nearest first; at most two
  std::optional<int64_t> next; ///< of the first numbered block after it
};

Neighbours neighbours(Snapshot &snapshot, uint32_t line) {
  const llvm::ArrayRef<uint32_t> blocks = snapshot.blocks();
  const FileIndex &index = snapshot.unit().index;
  const ProgramInfo &program = index.programAt(line);
  const auto split = std::lower_bound(blocks.begin(), blocks.end(), line);
  Neighbours found;
  Block block;
  bool seen = false;
  unsigned looked = 0;
  for (auto at = split; at != blocks.begin() && found.before.size() < 2;) {
    --at;
    if (++looked > mostBlocksLooked || *at < program.begin)
      break;
    snapshot.unit().reader->read(*at, block);
    if (block.kind == BlockKind::Empty && block.number < 0)
      continue;
    if (!seen) {
      found.last = block;
      seen = true;
    }
    if (block.number >= 0)
      found.before.push_back(block.number);
  }
  looked = 0;
  for (auto at = split; at != blocks.end() && *at < program.end; ++at) {
    if (++looked > mostBlocksLooked)
      break;
    snapshot.unit().reader->read(*at, block);
    if (block.number >= 0 && block.begin >= line) {
      found.next = block.number;
      break;
    }
  }
  return found;
}

} // namespace

std::optional<TextEdit> numberOfNewBlock(Snapshot &snapshot, uint32_t offset) {
  const llvm::StringRef text = snapshot.text();
  const LineIndex &lines = snapshot.source().lines();
  if (snapshot.dialect().addresses[letterAddress('N')].kind != AddressKind::Number ||
      offset > text.size())
    return std::nullopt;
  const uint32_t begin = lines.lineBegin(offset), end = lines.lineEnd(offset);
  const llvm::StringRef line = text.slice(begin, end).ltrim(" \t");
  if (begin == 0 ||
      (line.size() > 1 && (line[0] | 32) == 'n' && line[1] >= '0' && line[1] <= '9') ||
      line.startswith(":") || line.startswith("%"))
    return std::nullopt;
  const Neighbours near = neighbours(snapshot, begin);
  // The block before must have a number, at the begin of its line.
  if (near.before.empty() || near.last.number != near.before.front() || near.last.mainBlock ||
      !near.last.numberIsFirst || near.last.numberBegin >= near.last.numberEnd)
    return std::nullopt;
  // A block of several lines may go on here.
  if (snapshot.dialect().lexical.blocksSpanLines && near.last.begin < lines.lineBegin(begin - 1))
    return std::nullopt;
  const int64_t last = near.before[0];
  const int64_t step =
      near.before.size() > 1 && last > near.before[1] ? last - near.before[1] : usualStep;
  int64_t number = last + step;
  if (near.next && *near.next > last && number >= *near.next)
    number = last + (*near.next - last) / 2;
  const FileIndex &index = snapshot.unit().index;
  if (number == last || index.block(index.programAt(begin), number, begin))
    return std::nullopt;
  // Spelled as before: the mark, and what follows the number.
  const char mark = text[near.last.numberBegin];
  const bool glued = near.last.numberEnd < text.size() && text[near.last.numberEnd] != ' ' &&
                     text[near.last.numberEnd] != '\t' && text[near.last.numberEnd] != '\n' &&
                     text[near.last.numberEnd] != '\r';
  std::string inserted = std::string(1, mark) + std::to_string(number) + (glued ? "" : " ");
  const auto at = uint32_t(end - line.size());
  return TextEdit{{snapshot.source().id(), at, at}, std::move(inserted)};
}

} // namespace ncvet::lsp
