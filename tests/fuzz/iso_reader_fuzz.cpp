// Fuzzes the reader of word-address programs: it always gets on, and every block start is a place
// to begin from.
#include "formats/dialect/control_facts.h"
#include "tests/fuzz/reader_promises.h"

using namespace ncvet;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size == 0)
    return 0;
  // The first byte chooses the spelling, so that every switch of it is met.
  const uint8_t spelling = data[0];
  Dialect dialect;
  dialect.facts = std::make_shared<ControlFacts>();
  dialect.id = "fuzz";
  dialect.reader = "iso";
  dialect.lexical.incrementOperator = spelling & 1;
  dialect.lexical.commaAddresses =
      spelling & 2 ? maskOf(commaA) | maskOf(commaC) | maskOf(commaR) : 0;
  dialect.lexical.semicolon = spelling & 4 ? Semicolon::EndOfBlock : Semicolon::Comment;
  dialect.lexical.percentHeader = spelling & 8;
  dialect.lexical.macro = !(spelling & 16);
  dialect.lexical.skipLevels = spelling & 32 ? 1 : 9;
  dialect.lexical.flowWords = dialect.lexical.freeNumbers = spelling & 64;
  dialect.lexical.arithmetic = spelling & 128 ? Arithmetic::Ngc : Arithmetic::MacroB;
  if (spelling & 64)
    dialect.addressNames = {"@n", "^n", "$n"};
  const llvm::StringRef text(reinterpret_cast<const char *>(data) + 1, size - 1);
  fuzz::readAll(dialect, text);
  return 0;
}
