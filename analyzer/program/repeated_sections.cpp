// The sections of a program that statements of it repeat, as the text says it.
#include "analyzer/program/repeated_sections.h"

#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"
#include "interp/evaluate/condition.h"

namespace ncvet {

namespace {

std::optional<uint32_t> blockNamed(const FileIndex &index, const Block &block,
                                   const Argument &argument, uint32_t from, Search search) {
  Reference reference;
  reference.search = search;
  if (argument.kind == ArgumentKind::Label) {
    reference.to = ReferredKind::Label;
    reference.text = index.source().text(argument.begin, argument.end);
  } else {
    const auto number = block.numberIn(argument.expression);
    if (argument.kind != ArgumentKind::BlockNumber || !number)
      return std::nullopt;
    reference.to = ReferredKind::Block;
    reference.number = int64_t(*number);
  }
  return resolveBlock(index, index.programAt(block.begin), reference, from);
}

} // namespace

std::optional<uint32_t> blockNamed(const FileIndex &index, const Block &block, const Item &item,
                                   const Argument &argument) {
  return blockNamed(index, block, argument, block.begin, searchOf(searchKind(item, argument)));
}

std::vector<RepeatedSection> repeatedSections(const FileIndex &index) {
  std::vector<RepeatedSection> sections;
  const Reader &reader = index.reader();
  Block last;
  for (const Block &block : blocks(reader)) {
    for (const Item &item : block.items) {
      if (item.kind != ItemKind::Repeat || item.arguments != 2)
        continue;
      const auto places = block.argumentsOf(item);
      const auto from = blockNamed(index, block, item, places[0]);
      // The end is looked for from the begin on.
      const auto to =
          from ? blockNamed(index, block, places[1], std::max(*from, 1u) - 1, Search::Anywhere)
               : from;
      if (!from || !to || *to < *from || *to >= block.begin)
        continue;
      reader.read(*to, last);
      sections.push_back({block.begin, *from, *to, last.next, item.begin, item.end});
    }
  }
  return sections;
}

CountedFrame countedFrame(const FileIndex &index, const Dialect &dialect,
                          const RepeatedSection &section) {
  for (const Block &block : blocks(index, section.first, section.after)) {
    for (const Word &word : block.words) {
      const CodeIndex code = codeOf(dialect, word);
      if (code == noCode || dialect.codes[code].action != Action::FrameAdd)
        continue;
      for (const Notice &notice : dialect.codes[code].notices)
        for (const FormulaStep &step : notice.when.formula.steps)
          if (notice.rule == "flow-loop-counter" && step.op == FormulaOp::GivenVariable)
            return {&dialect.codes[code], uint64_t(step.number)};
    }
  }
  return {};
}

} // namespace ncvet
