// Codes that end a program, or return from it.
#include "analyzer/flow/endings.h"

#include "analyzer/program/block_reading.h"

namespace ncvet {

namespace {

/// Whether the block leaves the blocks round it by something else than a code that ends.
bool leavesByItem(const Block &block) {
  return llvm::any_of(block.items, [&](const Item &i) {
    constexpr uint64_t alarm = 3000; // #3000 stops the program; a computed variable may be it
    return i.kind == ItemKind::Jump || i.kind == ItemKind::Input || i.kind == ItemKind::Call ||
           (i.kind == ItemKind::Assignment &&
            (block.keyOf(i.target) == alarm || !block.keyOf(i.target)));
  });
}

bool callsMacro(const Block &block, const Dialect &dialect) {
  return llvm::any_of(block.words, [&](const Word &word) {
    const CodeIndex code = codeOf(dialect, word);
    return code != noCode && (dialect.codes[code].action == Action::MacroCall ||
                              dialect.codes[code].action == Action::MacroModal);
  });
}

bool ends(const Block &block, const Dialect &dialect) {
  Endings endings;
  endings.add(block, dialect);
  return endings.any();
}

/// Reads blocks from the run's begin on, up to `stop`, into the run.
void readRun(const FileUnit &unit, uint32_t stop, EndingRun &run) {
  Block block;
  for (; run.end < stop && run.blocks < longestRun; ++run.blocks) {
    unit.reader->read(run.end, block);
    Endings here;
    here.add(block, *unit.dialect);
    run.ends |= here.ends;
    run.returns |= here.returns;
    run.end = block.next;
  }
}

} // namespace

void Endings::add(const Block &block, const Dialect &dialect) {
  constexpr AddressMask codes = maskOf('M') | maskOf(keywordAddress);
  if (!block.hasAny(codes))
    return;
  for (const Word &word : block.words) {
    if (!(codes & maskOf(word.address)))
      continue;
    const CodeIndex code = codeOf(dialect, word);
    const Action action = code == noCode ? Action::None : dialect.codes[code].action;
    ends |= action == Action::ProgramEnd || action == Action::ProgramEndRewind;
    returns |= action == Action::Return;
  }
}

Endings endingsOf(const FileUnit &unit, uint32_t begin, uint32_t end, StraightRuns *runs) {
  Endings all;
  for (uint32_t at = begin; at < end;) {
    const EndingRun *known = runs ? runs->endings.find(at) : nullptr;
    EndingRun run;
    if (known && known->end <= end) {
      run = *known;
    } else {
      run.begin = run.end = at;
      readRun(unit, runs ? std::min(end, runs->endings.next(at + 1)) : end, run);
      if (runs)
        runs->endings.insert(run);
    }
    all.ends |= run.ends;
    all.returns |= run.returns;
    at = run.end;
  }
  return all;
}

bool holdsEnd(const FileUnit &unit, uint32_t begin, uint32_t end) {
  for (const Block &block : blocks(*unit.reader, begin, end))
    if (ends(block, *unit.dialect) && block.skip < 0)
      return true;
  return false;
}

bool holdsWayOut(const FileUnit &unit, uint32_t begin, uint32_t end) {
  for (const Block &block : blocks(*unit.reader, begin, end))
    if (ends(block, *unit.dialect) || block.has(letterAddress('M')) || leavesByItem(block) ||
        callsMacro(block, *unit.dialect))
      return true;
  return false;
}

} // namespace ncvet
