// Help on the word at a place: codes, addresses, parameters and variables.
#include "analyzer/flow/states_at_block.h"
#include "lsp/features/showing/word_help.h"
#include "tests/support/marked_text.h"

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using testing::HasSubstr;

struct Helped {
  std::string word, markdown;
};

/// Help at the first mark of the program; with the state there when the program runs.
Helped helpAt(llvm::StringRef dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  Block block;
  text->readAt(text.marks[0], block);
  const StatesAt states = statesAt(text->project(), text->unit(), text->unit(), block.begin);
  const auto help = lsp::wordHelp(*text, text.marks[0],
                                  states.ways.empty() ? nullptr : &states.ways.front().before);
  if (!help)
    return {};
  return {text->text().slice(help->range.begin, help->range.end).str(), help->markdown};
}

TEST(WordHelp, ACodeTellsWhatItDoesAndItsWords) {
  const Helped help = helpAt("haas-lathe", "O1\nG<|>83 Z-20. R2. Q5. F.1\nM30\n");
  EXPECT_EQ(help.word, "G83");
  EXPECT_THAT(help.markdown, HasSubstr("**G83** peck drilling"));
  EXPECT_THAT(help.markdown, HasSubstr("drilling cycle"));
  EXPECT_THAT(help.markdown, HasSubstr("ended by `G80`"));
  EXPECT_THAT(help.markdown, HasSubstr("- `Q` peck depth, above 0"));
  EXPECT_THAT(help.markdown, HasSubstr("L21-279"));
}

TEST(WordHelp, ADwellWithoutAPointIsInMilliseconds) {
  const Helped help = helpAt("haas-lathe", "O1\nG04 <|>P2\nM30\n");
  EXPECT_EQ(help.word, "P2");
  EXPECT_THAT(help.markdown, HasSubstr("dwell time"));
  EXPECT_THAT(help.markdown, HasSubstr("`P2` = 2 ms"));
  EXPECT_THAT(helpAt("haas-lathe", "O1\nG04 <|>P2.\nM30\n").markdown, HasSubstr("`P2.` = 2 s"));
}

TEST(WordHelp, AWordOfAnActiveCycleIsTheCycles) {
  EXPECT_THAT(helpAt("haas-mill", "O1\nG83 Z-20. R2. Q5. F100.\nX5. <|>Q6.\nM30\n").markdown,
              HasSubstr("**Q** peck depth"));
}

TEST(WordHelp, TheCoordinateOfAHoleIsTheCycles) {
  const std::string drilling = "O1\nG90 G54 G0 X0. Y0. Z5.\nG81 X1. Z-5. R1. F100.\n";
  EXPECT_THAT(helpAt("fanuc-0m", drilling + "X<|>2.\nG80\nM30\n").markdown, HasSubstr("– `G81`"));
  EXPECT_THAT(helpAt("fanuc-0m", drilling + "G80\nG0 X<|>2.\nM30\n").markdown,
              HasSubstr("– `G00`"));
}

TEST(WordHelp, AnArgumentIsNamedByItsCycle) {
  const Helped help = helpAt("sinumerik", "CYCLE81(10,0,<|>2,-8)\nM30\n");
  EXPECT_EQ(help.word, "2");
  EXPECT_THAT(help.markdown, HasSubstr("**SDIS** safety distance"));
  EXPECT_THAT(help.markdown, HasSubstr("`CYCLE81`"));
}

TEST(WordHelp, AKeywordIsACode) {
  EXPECT_THAT(helpAt("sinumerik", "TR<|>ANS X5\nM30\n").markdown, HasSubstr("**TRANS** shift"));
  EXPECT_THAT(helpAt("ecs", "<M<|>IR:ON>\n").markdown, HasSubstr("MIR"));
}

TEST(WordHelp, AVariableThatCyclesReadNamesThem) {
  EXPECT_THAT(helpAt("ecs", "N10 <E<|>NT=-10>\n").markdown, HasSubstr("depth"));
  EXPECT_THAT(helpAt("mefi", "N10 <|>R30=2\n").markdown, HasSubstr("start plane"));
}

TEST(WordHelp, AVariableTellsItsValue) {
  const Helped help = helpAt("fanuc-0m", "O1\n#100=5.\nG00 X<|>#100\nM30\n");
  EXPECT_EQ(help.word, "#100");
  EXPECT_THAT(help.markdown, HasSubstr("common"));
  EXPECT_THAT(help.markdown, HasSubstr("Here: 5"));
  EXPECT_THAT(helpAt("linuxcnc", "#<depth>=3\nG0 X#<de<|>pth>\nM2\n").markdown,
              HasSubstr("Here: 3"));
}

TEST(WordHelp, AVariableThatIsSetIsNamedAsItIsWritten) {
  EXPECT_EQ(helpAt("fanuc-0m", "O1\n#1<|>00=5.\nM30\n").word, "#100");
  EXPECT_EQ(helpAt("fanuc-0m", "O1\n<|>#100=5.\nM30\n").word, "#100");
  EXPECT_THAT(helpAt("linuxcnc", "#<dep<|>th>=5\n").markdown, HasSubstr("**#<depth>** variable"));
  EXPECT_EQ(helpAt("sinumerik", "R<|>1=5\n").word, "R1");
}

TEST(WordHelp, ACommentNeedsNone) {
  EXPECT_EQ(helpAt("haas-mill", "O1 (A<|> PART)\nM30\n").markdown, "");
}

TEST(WordHelp, AnUnknownCodeIsSaidToBeUnknown) {
  EXPECT_THAT(helpAt("haas-mill", "O1\nG9<|>99\nM30\n").markdown, HasSubstr("no code"));
}

TEST(WordHelp, NoPlaceOfABrokenProgramBreaksIt) {
  const llvm::StringRef broken = "N10 G1 X= Y[ #[ IF[ <MIR:; CYCLE81(,,\nG65 P ((\n%\nGOTO\n\"";
  for (const char *dialect : {"haas-lathe", "fanuc-0m", "sinumerik", "ecs", "mefi", "linuxcnc"}) {
    const auto text = test::markedText(dialect, broken);
    for (uint32_t at = 0; at <= broken.size(); ++at)
      lsp::wordHelp(*text, at);
  }
}

} // namespace
