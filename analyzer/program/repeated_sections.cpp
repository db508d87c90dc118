// The sections of a program that statements of it repeat, as the text says it.
#include "analyzer/program/repeated_sections.h"

#include "interp/evaluate/condition.h"

namespace ncvet {

std::optional<uint32_t> blockNamed(const FileIndex &index, const Block &block,
                                   const Argument &argument, uint32_t from) {
  const ProgramInfo &program = index.programAt(from);
  if (argument.kind == ArgumentKind::Label)
    return index.label(program, index.source().text(argument.begin, argument.end), from);
  if (argument.kind != ArgumentKind::BlockNumber || argument.expression >= block.expressions.size())
    return std::nullopt;
  const Expression &number = block.expressions[argument.expression];
  if (number.bad || number.count != 1 || block.operations[number.first].op != Op::Number)
    return std::nullopt;
  return index.block(program, int64_t(block.operations[number.first].value), from);
}

std::vector<RepeatedSection> repeatedSections(const FileIndex &index) {
  std::vector<RepeatedSection> sections;
  const Reader &reader = index.reader();
  Block block, last;
  for (uint32_t at = reader.first(); at < index.source().text().size(); at = block.next) {
    reader.read(at, block);
    for (const Item &item : block.items) {
      if (item.kind != ItemKind::Repeat || item.arguments != 2)
        continue;
      const auto places = block.argumentsOf(item);
      const auto from = blockNamed(index, block, places[0], block.begin);
      const auto to = blockNamed(index, block, places[1], block.begin);
      if (!from || !to || *to < *from || *to >= block.begin)
        continue;
      reader.read(*to, last);
      sections.push_back({block.begin, *from, *to, last.next, item.begin, item.end});
    }
    if (block.next <= at)
      break;
  }
  return sections;
}

CountedFrame countedFrame(const FileIndex &index, const Dialect &dialect,
                          const RepeatedSection &section) {
  Block block;
  for (uint32_t at = section.first; at < section.behind; at = block.next) {
    index.read(at, block);
    for (const Word &word : block.words) {
      const CodeIndex code = codeOf(dialect, word);
      if (code == noCode || dialect.codes[code].action != Action::FrameAdd)
        continue;
      for (const Notice &notice : dialect.codes[code].notices)
        for (const FormulaStep &step : notice.when.formula.steps)
          if (notice.rule == "flow-loop-counter" && step.op == FormulaOp::GivenVariable)
            return {&dialect.codes[code], uint64_t(step.number)};
    }
    if (block.next <= at)
      break;
  }
  return {};
}

} // namespace ncvet
