// Code lenses over programs, contours and tools.
#include "lsp/features/showing/code_lens.h"
#include "tests/support/marked_text.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"

#include <fstream>
#include <map>

namespace {

using namespace ncvet;

/// `line: title`, one a line.
std::string lensesOf(llvm::StringRef dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  std::string out;
  for (const lsp::CodeLens &lens : lsp::codeLenses(*text))
    out +=
        std::to_string(text->source().position(lens.range.begin).line) + ": " + lens.title + "\n";
  return out;
}

TEST(CodeLens, ProgramsCountTheirCallers) {
  EXPECT_EQ(lensesOf("fanuc-0m", "O1\nM98 P20\nG65 P20 A1.\nM30\nO20\nM99\nO30\nM99\n"),
            "5: 2 callers\n7: no callers found\n");
  EXPECT_EQ(lensesOf("nct-104m", "%O0001\nM98 P30020\nM30\n%O0020\nM99\n"), "4: 1 caller\n");
  EXPECT_EQ(lensesOf("sinumerik", "%_N_MAIN_MPF\nPART\nM30\n%_N_PART_SPF\nRET\n"), "4: 1 caller\n");
  EXPECT_EQ(lensesOf("linuxcnc", "o<a> sub\nG0 X1\no<a> endsub\no<a> call\nM2\n"), "1: 1 caller\n");
  EXPECT_EQ(lensesOf("haas-lathe", "O1\nM97 P100\nM30\nN100 G00 X1.\nM99\n"), "4: 1 caller\n");
}

TEST(CodeLens, CallersInOtherFilesCount) {
  const test::TemporaryFolder folder;
  const std::map<std::string, std::string> files = {
      {"O0001.nc", "%\nO0001\nM98 P20\nM98 P20\nM30\n%\n"},
      {"O0020.nc", "%\nO0020\nG00 X1.\nM99\n%\n"},
      {"SHAFT.MPF", "G90\nPART\nM30\n"},
      {"PART.SPF", "G0 X1\nRET\n"}};
  for (const auto &[name, text] : files)
    std::ofstream(folder.path() / name) << text;
  const auto lenses = [&](llvm::StringRef dialect, const std::string &file) {
    const auto text = test::markedText(dialect, files.at(file), (folder.path() / file).string());
    std::string out;
    for (const lsp::CodeLens &lens : lsp::codeLenses(*text)) {
      out += std::to_string(text->source().position(lens.range.begin).line) + ": " + lens.title;
      for (const SourceRange &place : lens.places) {
        const SourceFile &caller = text->project().sources().get(place.file);
        out += " " + std::to_string(caller.position(place.begin).line);
      }
    }
    return out;
  };
  EXPECT_EQ(lenses("fanuc-0m", "O0020.nc"), "2: 2 callers 3 4");
  EXPECT_EQ(lenses("sinumerik", "PART.SPF"), "1: 1 caller 2") << "it has no head of its own";
}

TEST(CodeLens, ToolsCountTheirBlocks) {
  EXPECT_EQ(lensesOf("haas-lathe", "O1\nT101\nG00 X10.\nT202\nM30\n"),
            "2: T101: 2 blocks\n4: T202: 2 blocks\n");
  EXPECT_EQ(lensesOf("haas-mill", "O1\nT1 M06\nT2\nG00 X10.\nM06\nM30\n"),
            "2: T1: 3 blocks\n5: T2: 2 blocks\n");
}

TEST(CodeLens, CompensatedContoursTellTheLargestRadius) {
  const std::string lenses =
      lensesOf("fanuc-0m", "O1\nG21 G17 G90 G40 G54\nT1 M06\nS1000 M03\nG00 X-20. Y0.\nG01 Z-1. "
                           "F100.\nG41 X0. D1\nY20.\nG03 X10. Y10. R10.\nG01 X30.\nG40 Y-20.\n"
                           "M30\n");
  EXPECT_NE(lenses.find("7: safe up to R10.00\n"), std::string::npos) << lenses;
}

TEST(CodeLens, AContourIsFollowedWhenItsLensIsLookedAt) {
  const auto text = test::markedText(
      "fanuc-0m", "O1\nG21 G17 G90 G40 G54\nT1 M06\nS1000 M03\nG00 X-20. Y0.\nG01 Z-1. F100.\nG41 "
                  "X0. D1\nY20.\nG03 X10. Y10. R10.\nG01 X30.\nG40 Y-20.\nM30\nG42 X5. D1\n");
  std::string titles;
  for (const lsp::CodeLens &lens : lsp::lensesToResolve(*text))
    titles +=
        std::to_string(text->source().position(lens.range.begin).line) + ":" + lens.title +
        (lens.title.empty() ? lsp::titleOfContour(*text, lens.range.begin) + " (later)" : "") +
        "\n";
  EXPECT_EQ(titles, "3:T1: 11 blocks\n7:safe up to R10.00 (later)\n13: (later)\n")
      << "after the end nothing is executed, and nothing is known";
}

TEST(CodeLens, AnyTextHasLenses) {
  const llvm::StringRef broken = "N10 G1 X= Y[ #[ IF[ <MIR:; CYCLE81(,,\nG65 P ((\n%\nM98 P\n\"";
  for (const char *dialect : {"haas-lathe", "fanuc-0m", "sinumerik", "ecs", "mefi", "linuxcnc"})
    lensesOf(dialect, broken);
}

} // namespace
