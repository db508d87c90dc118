// Navigation in texts that are no programs: nothing fails, and every range lies in the text.
#include "lsp/features/navigation/call_hierarchy.h"
#include "lsp/features/navigation/definition.h"
#include "lsp/features/navigation/folding.h"
#include "lsp/features/navigation/highlight.h"
#include "lsp/features/navigation/links.h"
#include "lsp/features/navigation/references.h"
#include "lsp/features/navigation/selection.h"
#include "lsp/features/navigation/symbols.h"
#include "lsp/features/writing/rename.h"
#include "tests/support/marked_text.h"

#include "gtest/gtest.h"

#include <random>

namespace {

using namespace ncvet;
using namespace ncvet::lsp;

constexpr const char *dialects[] = {"haas-lathe", "fanuc-0m", "sinumerik",
                                    "ecs",        "mefi",     "linuxcnc"};

void expectInside(const Snapshot &snapshot, SourceRange range) {
  EXPECT_LE(range.begin, range.end);
  EXPECT_LE(range.end, snapshot.text().size());
}

void expectInside(const Snapshot &snapshot, const std::vector<Symbol> &symbols) {
  for (const Symbol &symbol : symbols) {
    expectInside(snapshot, symbol.full);
    EXPECT_LE(symbol.full.begin, symbol.selection.begin);
    EXPECT_LE(symbol.selection.end, symbol.full.end);
    EXPECT_FALSE(symbol.name.empty());
    expectInside(snapshot, symbol.children);
  }
}

void useEverything(Snapshot &snapshot, uint32_t offset) {
  uint32_t last = 0;
  for (const Occurrence &one : snapshot.names().all()) {
    expectInside(snapshot, snapshot.names().range(one));
    EXPECT_LE(last, one.begin);
    last = one.begin;
  }
  definition(snapshot, offset);
  for (const SourceRange &range : references(snapshot, offset, true))
    expectInside(snapshot, range);
  highlights(snapshot, offset);
  expectInside(snapshot, documentSymbols(snapshot));
  for (const Fold &fold : folds(snapshot))
    expectInside(snapshot, fold.range);
  for (const auto &chain : selections(snapshot, {offset}))
    EXPECT_FALSE(chain.empty());
  links(snapshot);
  if (const auto item = callItem(snapshot, offset)) {
    expectInside(snapshot, item->full);
    outgoingCalls(snapshot, snapshot.source().path(), item->selection.begin);
    incomingCalls(snapshot, snapshot.source().path(), item->selection.begin);
  }
  prepareRename(snapshot, offset);
  for (const char *name : {"77", "ZZTOP"})
    for (const TextEdit &edit : rename(snapshot, offset, name).edits)
      expectInside(snapshot, edit.range);
}

TEST(BrokenText, OfBracketsTargetsAndHeadersWithoutTheirOtherHalf) {
  for (const char *dialect : dialects)
    for (const char *program :
         {"<|>", "%<|>", "O<|>", "%\n%<|>", "END1\n<|>ELSE\nENDIF\n",
          "o1 endsub\no1 else<|>\no1 if", "IF\nIF\nELSE\nELSE\nENDIF<|>", "<RPT:N1;N<|>1>\nN1",
          "G71 P2 Q<|>1\nN1\nN2", "N N\nT\nM6<|> T", "#1=#<|>", "N1<|>", "M99 P1<|>\nN1 M98 P",
          "o<<|>", "[<|>", "%_N_<|>_SPF", "DEF REAL A<|>", "L<<|>>"}) {
      const auto text = test::markedText(dialect, program);
      useEverything(*text, text.marks[0]);
    }
}

TEST(BrokenText, OfAnyBytes) {
  constexpr llvm::StringLiteral pieces[] = {
      "N10 ",          "G71 P10 Q20 ",      "M98 P2 ",  "M99 P10\n",   "O2\n",
      "#1=#[2]+#100 ", "GOTO 10\n",         "o1 sub\n", "o1 endsub\n", "o1 call [1]\n",
      "%_N_A_SPF\n",   "DEF REAL AB=1\n",   "AB: ",     "GOTOB AB\n",  "<JMP:N10>\n",
      "[AB] ",         "L<AB>\n",           "R1=R2\n",  "T0101 ",      "M6 ",
      "G81 X1 Z-5\n",  "(note)\n",          "\"note\n", "\r\n",        "IF R1>2\n",
      "ENDIF\n",       "WHILE[#1LT2]DO1\n", "END1\n",   "\xFF\xFE",    "\x1A"};
  std::mt19937 random(20);
  for (const char *dialect : dialects)
    for (unsigned run = 0; run < 40; ++run) {
      std::string program;
      for (unsigned i = 0; i < 30; ++i)
        program += pieces[random() % std::size(pieces)];
      for (unsigned i = 0; i < run % 8; ++i)
        program[random() % program.size()] = char(random());
      program.insert(random() % program.size(), "<|>");
      const auto text = test::markedText(dialect, program);
      if (!text.marks.empty())
        useEverything(*text, text.marks[0]);
    }
}

} // namespace
