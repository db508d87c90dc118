// Fuzzes the reader of word-address programs: it always gets on, and every block start is a place
// to begin from.
#include "formats/readers/reader.h"

#include <cstdint>
#include <cstdlib>

namespace {

using namespace ncvet;

void require(bool holds) {
  if (!holds)
    std::abort();
}

bool sameWord(const Word &a, const Word &b) {
  return a.address == b.address && a.flags == b.flags && a.decimals == b.decimals &&
         a.length == b.length && a.offset == b.offset && a.mantissa == b.mantissa;
}

/// What later layers see of a block.
bool sameBlock(const Block &a, const Block &b) {
  if (a.kind != b.kind || a.begin != b.begin || a.end != b.end || a.next != b.next ||
      a.skip != b.skip || a.number != b.number || a.program != b.program ||
      a.addresses != b.addresses || a.words.size() != b.words.size() ||
      a.items.size() != b.items.size() || a.expressions.size() != b.expressions.size() ||
      a.operations.size() != b.operations.size() || a.comments.size() != b.comments.size() ||
      a.issues.size() != b.issues.size())
    return false;
  for (size_t i = 0; i < a.words.size(); ++i)
    if (!sameWord(a.words[i], b.words[i]))
      return false;
  for (size_t i = 0; i < a.issues.size(); ++i)
    if (a.issues[i].kind != b.issues[i].kind || a.issues[i].begin != b.issues[i].begin ||
        a.issues[i].end != b.issues[i].end)
      return false;
  return true;
}

/// Everything that a block points at lies inside it, and all of its indices inside its vectors.
void requireConsistent(const Block &block, size_t size) {
  require(block.begin <= block.end && block.end <= block.next && block.next <= size);
  for (const Word &word : block.words) {
    require(word.offset >= block.begin && word.offset <= block.end);
    require(block.endOf(word) <= block.end);
    require(block.addresses & maskOf(word.address));
    if (word.has(wordExpression))
      require(static_cast<uint64_t>(word.mantissa) < block.expressions.size());
  }
  for (const Item &item : block.items)
    for (const uint16_t expression : {item.target, item.value, item.condition})
      require(expression == noExpression || expression < block.expressions.size());
  for (const Expression &expression : block.expressions)
    require(expression.first + expression.count <= block.operations.size());
  for (const Comment &comment : block.comments)
    require(comment.begin < comment.end && comment.end <= block.next);
  for (const SyntaxIssue &issue : block.issues)
    require(issue.begin <= issue.end && issue.end <= block.next);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size == 0)
    return 0;
  // The first byte chooses the spelling, so that every switch of it is met.
  const uint8_t spelling = data[0];
  Dialect dialect;
  dialect.id = "fuzz";
  dialect.reader = "iso";
  dialect.lexical.incrementOperator = spelling & 1;
  dialect.lexical.commaAddresses =
      spelling & 2 ? maskOf(commaA) | maskOf(commaC) | maskOf(commaR) : 0;
  dialect.lexical.semicolon = spelling & 4 ? Semicolon::EndOfBlock : Semicolon::Comment;
  dialect.lexical.percentHeader = spelling & 8;
  dialect.lexical.macro = !(spelling & 16);
  dialect.lexical.skipLevels = spelling & 32 ? 1 : 9;
  const llvm::StringRef text(reinterpret_cast<const char *>(data) + 1, size - 1);
  const std::unique_ptr<Reader> reader = makeReader(dialect, text);
  Block block;
  for (uint32_t offset = reader->first(); offset < text.size(); offset = block.next) {
    reader->read(offset, block);
    require(block.next > offset);
    requireConsistent(block, text.size());
    // A fresh block read from the same place: nothing is left of the blocks before.
    Block fresh;
    reader->read(offset, fresh);
    require(sameBlock(block, fresh));
  }
  return 0;
}
