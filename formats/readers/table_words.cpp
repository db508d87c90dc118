// Finds the codes of a table in a block, and the words that their formats name.
#include "formats/readers/table_words.h"

namespace ncvet {

CodeIndex codeOf(const Dialect &dialect, const Word &word) {
  if (word.address == keywordAddress)
    return CodeIndex(word.mantissa);
  if ((word.address != letterAddress('G') && word.address != letterAddress('M')) ||
      !word.isNumber())
    return noCode;
  return dialect.find(char('A' + word.address), word.codeNumber());
}

const Word *assignmentOf(const Block &block, uint64_t variable) {
  if (!block.has(variableAddress))
    return nullptr;
  const Word *last = nullptr; // the last one counts
  for (const Item &item : block.items)
    if (item.kind == ItemKind::Assignment && block.keyOf(item.target) == variable)
      for (const Word &word : block.words)
        if (word.address == variableAddress && word.offset == item.begin)
          last = &word;
  return last;
}

const Word *wordFor(const Block &block, const WordSpec &spec) {
  if (spec.position) {
    const Word *word = block.argument(spec.position);
    return word && !word->has(wordNoValue) ? word : nullptr;
  }
  if (spec.variable)
    return assignmentOf(block, spec.variable);
  return block.findAny(spec.any);
}

} // namespace ncvet
