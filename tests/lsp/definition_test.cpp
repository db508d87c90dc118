// Definitions: where a name leads, in the file and beyond it.
#include "lsp/features/navigation/definition.h"
#include "tests/support/marked_text.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"

#include <fstream>

namespace {

using namespace ncvet;
using namespace ncvet::lsp;

/// Text of the line to which the first mark leads; empty: nowhere.
std::string lineOf(const test::MarkedText &text) {
  const auto place = definition(*text, text.marks[0]);
  if (!place)
    return {};
  const SourceFile &file = text->project().sources().get(place->name.file);
  return file.displayLine(file.position(place->name.begin).line);
}

std::string lineOf(const char *dialect, llvm::StringRef program) {
  return lineOf(test::markedText(dialect, program));
}

TEST(Definition, OfBlocks) {
  EXPECT_EQ(lineOf("haas-lathe", "G71 P10 Q2<|>0 D1. F0.2\nN10 X1.\nN20 X2.\n"), "N20 X2.");
  EXPECT_EQ(lineOf("haas-lathe", "M97 P<|>200\nM30\nN200 M99\n"), "N200 M99");
  EXPECT_EQ(lineOf("fanuc-0m", "N10 G0\nGOTO 1<|>0\nM30\n"), "N10 G0");
  EXPECT_EQ(lineOf("fanuc-0m", "GOTO #<|>1\nM30\n"), "");
  EXPECT_EQ(lineOf("fanuc-0m", "GOTO 1<|>1\nM30\n"), "");
  EXPECT_EQ(lineOf("ecs", "N10 G0\n<JMP:N1<|>0>\n"), "N10 G0");
}

TEST(Definition, OfAJumpFollowsItsDirection) {
  EXPECT_EQ(lineOf("sinumerik", "A1: G0\nGOTOB A<|>1\nA1: G1\n"), "A1: G0");
  EXPECT_EQ(lineOf("sinumerik", "A1: G0\nGOTOF A<|>1\nA1: G1\n"), "A1: G1");
  EXPECT_EQ(lineOf("fanuc-0m", "N1 G0\nGOTO <|>1\nN1 G1\n"), "N1 G1");
}

TEST(Definition, OfVariablesIsTheirDefinitionElseTheFirstWrite) {
  EXPECT_EQ(lineOf("fanuc-0m", "#1=2\n#1=3\nX#<|>1\n"), "#1=2");
  EXPECT_EQ(lineOf("sinumerik", "DEF REAL AA\nAA=2\nX=A<|>A\n"), "DEF REAL AA");
  EXPECT_EQ(lineOf("linuxcnc", "#<aa>=2\nX#<a<|>a>\n"), "#<aa>=2");
}

TEST(Definition, OfProgramsInTheFile) {
  EXPECT_EQ(lineOf("haas-lathe", "O1\nM98 P2<|>\nM30\nO00002 (SUB)\nM99\n"), "O00002 (SUB)");
  EXPECT_EQ(lineOf("sinumerik", "%_N_A_MPF\nHO<|>LE\nM30\n%_N_HOLE_SPF\nM17\n"), "%_N_HOLE_SPF");
  EXPECT_EQ(lineOf("linuxcnc", "o<hole> sub\no<hole> endsub\no<ho<|>le> call\n"), "o<hole> sub");
}

class DefinitionElsewhere : public testing::Test {
protected:
  void write(const char *name, const char *text) {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
  }
  std::string lineOf(const char *dialect, llvm::StringRef program) {
    return ::lineOf(test::markedText(dialect, program, (folder_.path() / "main.nc").string()));
  }
  test::TemporaryFolder folder_;
};

TEST_F(DefinitionElsewhere, OfProgramsInOtherFiles) {
  write("O2000.nc", "%\nO2000 (OTHER)\nM99\n");
  write("HOLE.SPF", "PROC HOLE\nM17\n");
  write("HOLES", "N50 X1\n[HERE] X2\nM17\n");
  write("hole2.ngc", "o<hole2> sub\no<hole2> endsub\n");
  EXPECT_EQ(lineOf("haas-lathe", "O1\nM98 P2<|>000\n"), "O2000 (OTHER)");
  EXPECT_EQ(lineOf("sinumerik", "HO<|>LE\n"), "PROC HOLE");
  EXPECT_EQ(lineOf("ecs", "L<HO<|>LES>\n"), "N50 X1");
  EXPECT_EQ(lineOf("ecs", "<JMC: HOLES; [HE<|>RE]>\n"), "[HERE] X2");
  EXPECT_EQ(lineOf("linuxcnc", "o<ho<|>le2> call\n"), "o<hole2> sub");
  EXPECT_EQ(lineOf("haas-lathe", "O1\nM98 P3<|>000\n"), "");
}

TEST(Definition, IsGivenWithItsBlock) {
  const auto text = test::markedText("fanuc-0m", "GOTO <|>10\n/ N10 G0 X1. (HERE)\n");
  const auto place = definition(*text, text.marks[0]);
  ASSERT_TRUE(place);
  EXPECT_EQ(text->text().slice(place->origin.begin, place->origin.end), "10");
  EXPECT_EQ(text->text().slice(place->name.begin, place->name.end), "10");
  EXPECT_EQ(text->text().slice(place->block.begin, place->block.end), "/ N10 G0 X1. (HERE)");
}

} // namespace
