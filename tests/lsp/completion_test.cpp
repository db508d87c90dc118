// Completion: what may be at the cursor, by block and control.
#include "analyzer/flow/states_at_block.h"
#include "lsp/features/writing/completion.h"
#include "tests/support/marked_text.h"

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using lsp::CompletionItem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Where control comes to the block at the mark.
std::optional<MachineState> stateAtMark(const test::MarkedText &text) {
  Block block;
  text->readAt(text.marks[0], block);
  const StatesAt states = statesAt(text->project(), text->unit(), text->unit(), block.begin);
  if (states.ways.empty())
    return std::nullopt;
  return states.ways.front().before;
}

/// Items at the mark, applied: what then is from the place that is replaced to the cursor.
std::vector<std::string>
insertedAt(llvm::StringRef dialect, llvm::StringRef program,
           std::string lsp::CompletionItem::*part = &lsp::CompletionItem::label) {
  const auto text = test::markedText(dialect, program);
  std::vector<std::string> all;
  const auto before = stateAtMark(text);
  for (const CompletionItem &item :
       lsp::completions(*text, text.marks[0], before ? &*before : nullptr)) {
    EXPECT_LE(item.replace.begin, text.marks[0]);
    EXPECT_EQ(item.replace.end, text.marks[0]);
    all.push_back(item.*part);
  }
  return all;
}

TEST(Completion, CodesThatBeginWithWhatIsTyped) {
  EXPECT_THAT(insertedAt("haas-mill", "O1\nG00 X1.\nG8<|>\nM30\n"),
              AllOf(Contains("G81"), Contains("G83"), Not(Contains("G01"))));
  EXPECT_THAT(insertedAt("haas-mill", "O1\nG0 X1.\nG<|>\nM30\n"),
              AllOf(Contains("G1"), Not(Contains("G01"))));
  EXPECT_THAT(insertedAt("sinumerik", "TRA<|>\n"), Contains("TRANS"));
  EXPECT_THAT(insertedAt("ecs", "<MI<|>\n"), Contains("<MIR:ON>"));
}

TEST(Completion, CodesInConflictWithTheBlockAreNotOffered) {
  EXPECT_THAT(insertedAt("haas-mill", "O1\nG00 G<|>\nM30\n"),
              AllOf(Contains("G90"), Not(Contains("G01"))));
  EXPECT_THAT(insertedAt("haas-lathe", "O1\nM03 M<|>\nM30\n"), Not(Contains("M08")));
  EXPECT_THAT(insertedAt("fanuc-0m", "O1\nM<|>\nM30\n"), Contains("M08"));
}

TEST(Completion, TheWordsOfACodeComeFirst) {
  const auto labels = insertedAt("fanuc-0m", "O1\nG83 Z-5. <|>\nM30\n");
  ASSERT_FALSE(labels.empty());
  EXPECT_THAT(std::vector<std::string>(labels.begin(), labels.begin() + 2),
              testing::UnorderedElementsAre("Q", "R"));
  EXPECT_THAT(labels, Not(Contains("Z")));
  EXPECT_THAT(insertedAt("ecs", "N10 G83 <<|>\n"), Contains("<ENT=>"));
  EXPECT_THAT(insertedAt("mefi", "N10 G81 <|>\n"), Contains("R30="));
}

TEST(Completion, CyclesAreSnippets) {
  EXPECT_THAT(insertedAt("sinumerik", "CYCLE81<|>\n", &CompletionItem::insert),
              Contains("CYCLE81(${1:RTP},${2:RFP},${3:SDIS},${4:DP},${5:DPR},${6:DTB})"));
  EXPECT_THAT(insertedAt("fanuc-0m", "O1\nG83<|>\n", &CompletionItem::insert),
              Contains(HasSubstr("Q${")));
}

TEST(Completion, OneOfSeveralWordsIsChosen) {
  EXPECT_THAT(insertedAt("fanuc-0t", "O1\nG04<|>\nM30\n", &CompletionItem::insert),
              Contains("G04 ${1|P,X,U|}${2:dwell time}"));
  EXPECT_THAT(insertedAt("linuxcnc", "G04<|>\n", &CompletionItem::insert),
              Contains(HasSubstr("G04 P${1:")));
}

TEST(Completion, WordsOfACycleAreNotOfferedInTheBlockThatEndsIt) {
  const std::string drilling = "O1\nG90 G54 G0 X0. Y0. Z5.\nG83 X1. Z-5. R1. Q1. F100.\n";
  EXPECT_EQ(insertedAt("fanuc-0m", drilling + "X2. <|>\nG80\nM30\n").front(), "Q");
  EXPECT_NE(insertedAt("fanuc-0m", drilling + "G02 X2. <|>\nG80\nM30\n").front(), "Q");
}

TEST(Completion, JumpsNameBlocks) {
  EXPECT_THAT(insertedAt("fanuc-0m", "O1\nN10 G00\nN20 GOTO<|>\nN30 M30\n"),
              testing::UnorderedElementsAre("10", "20", "30"));
  EXPECT_THAT(insertedAt("fanuc-0m", "O1\nN10 G00\nN20 GOTO 1<|>\nN30 M30\n"), ElementsAre("10"));
  EXPECT_THAT(insertedAt("sinumerik", "N10 START: G0 X1\nGOTOB <|>\n"),
              AllOf(Contains("START"), Contains("N10")));
  EXPECT_THAT(insertedAt("ecs", "N10 G0 X1\n<JMP: <|>>\n"), Contains("N10"));
  EXPECT_THAT(insertedAt("haas-lathe", "O1\nG71 P<|>\nN10 G00 X1.\nM30\n"), Contains("10"));
}

TEST(Completion, VariablesOfTheProgram) {
  EXPECT_THAT(insertedAt("fanuc-0m", "O1\n#100=1\n#101=#<|>\n"), ElementsAre("#100", "#101"));
  EXPECT_THAT(insertedAt("linuxcnc", "#<depth>=1\nG1 X#<<|>\n"), Contains("#<depth>"));
  EXPECT_THAT(insertedAt("sinumerik", "DEF REAL DEPTH\nR5=1\nG1 X=<|>\n"),
              AllOf(Contains("DEPTH"), Contains("R5")));
}

TEST(Completion, ProgramsThatCanBeCalled) {
  EXPECT_THAT(insertedAt("fanuc-0m", "O1\nM98 P<|>\nM30\nO20\nM99\n"), Contains("20"));
}

TEST(Completion, CommentsAndStringsAreLeftAlone) {
  EXPECT_THAT(insertedAt("haas-mill", "O1 (G<|>)\nM30\n"), IsEmpty());
  EXPECT_THAT(insertedAt("sinumerik", "G0 X1 ; G<|>\n"), IsEmpty());
  EXPECT_THAT(insertedAt("sinumerik", "MSG(\"G<|>\")\n"), IsEmpty());
}

TEST(Completion, AnItemIsDocumented) {
  const auto text = test::markedText("haas-mill", "O1\nG83<|>\n");
  const auto items = lsp::completions(*text, text.marks[0]);
  ASSERT_FALSE(items.empty());
  EXPECT_THAT(lsp::completionHelp(text->dialect(), items.front().documentation),
              HasSubstr("peck drilling"));
  EXPECT_EQ(lsp::completionHelp(text->dialect(), "code:999999"), "");
  EXPECT_EQ(lsp::completionHelp(text->dialect(), "nonsense"), "");
}

TEST(Completion, NoPlaceOfABrokenProgramBreaksIt) {
  const llvm::StringRef broken = "N10 G1 X= Y[ #[ IF[ <MIR:; CYCLE81(,,\nG65 P ((\n%\nGOTO\n\"";
  for (const char *dialect : {"haas-lathe", "fanuc-0m", "sinumerik", "ecs", "mefi", "linuxcnc"}) {
    const auto text = test::markedText(dialect, broken);
    for (uint32_t at = 0; at <= broken.size(); ++at)
      lsp::completions(*text, at);
  }
}

} // namespace
