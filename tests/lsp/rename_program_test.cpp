// Programs, and variables that programs share, renamed in all files that name them.
#include "lsp/features/writing/rename_program.h"
#include "lsp/features/writing/rename_shared.h"
#include "tests/support/marked_text.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"

#include <filesystem>
#include <fstream>
#include <map>

namespace {

using namespace ncvet;
using Texts = std::map<std::string, std::string>;

/// A folder of programs, one of them open.
class Programs {
public:
  explicit Programs(Texts files) : files_(std::move(files)) {
    for (const auto &[name, text] : files_) {
      std::ofstream(folder_.path() / name, std::ios::binary) << text;
      paths_.push_back((folder_.path() / name).string());
    }
  }

  /// The files after a rename of the name at `place` in one of them. The renamed file is there by
  /// its new name; `! why` when nothing is renamed.
  Texts renamed(llvm::StringRef dialect, const std::string &open, llvm::StringRef place,
                llvm::StringRef name) {
    const auto text = read(dialect, open);
    const size_t at = text->text().find(place);
    EXPECT_NE(at, std::string::npos);
    return after(*text, lsp::renameProgram(*text, uint32_t(at), name, paths_));
  }
  /// The same of a variable that programs share.
  Texts shared(llvm::StringRef dialect, const std::string &open, llvm::StringRef place,
               llvm::StringRef name) {
    const auto text = read(dialect, open);
    const auto at = uint32_t(text->text().find(place) + 1);
    const std::string why = lsp::whyNotShared(*text, at, paths_);
    lsp::SharedRename made = lsp::renameShared(*text, at, name, paths_);
    EXPECT_TRUE(why.empty() || why == made.refused) << why;
    return after(*text, {std::move(made.edits), "", "", std::move(made.refused)});
  }
  /// The same where the open file is moved by the editor.
  Texts moved(llvm::StringRef dialect, const std::string &open, const std::string &to) {
    const auto text = read(dialect, open);
    const lsp::ProgramRename made =
        lsp::renameWithFile(*text, (folder_.path() / to).string(), paths_);
    EXPECT_TRUE(made.from.empty());
    return after(*text, made);
  }

private:
  test::MarkedText read(llvm::StringRef dialect, const std::string &open) {
    return test::markedText(dialect, files_.at(open), (folder_.path() / open).string());
  }

  Texts after(lsp::Snapshot &snapshot, const lsp::ProgramRename &made) {
    if (!made.refused.empty()) {
      EXPECT_TRUE(made.edits.empty());
      return {{"!", made.refused}};
    }
    Texts texts = files_;
    std::map<FileId, std::vector<TextEdit>> byFile;
    for (const TextEdit &edit : made.edits)
      byFile[edit.range.file].push_back(edit);
    for (const auto &[file, edits] : byFile) {
      const SourceFile &source = snapshot.project().sources().get(file);
      texts[nameOf(source.path())] = applyEdits(source.text(), edits);
    }
    if (!made.from.empty()) {
      auto node = texts.extract(nameOf(made.from));
      node.key() = nameOf(made.to);
      texts.insert(std::move(node));
    }
    return texts;
  }
  static std::string nameOf(const std::string &path) {
    return std::filesystem::path(path).filename().string();
  }

  const test::TemporaryFolder folder_;
  const Texts files_;
  std::vector<std::string> paths_;
};

const Texts plates = {{"O0001.nc", "%\nO0001\nM98 P20\nG65 P20 A1.\nM30\n%\n"},
                      {"O0020.nc", "%\nO0020 (HOLE)\nG00 X1.\nM99\n%\n"},
                      {"O0030.nc", "%\nO0030\nM98 P0020 L2\nM98 P31\nM30\n%\n"},
                      {"O0031.nc", "%\nO0031\nG00 X20.\nM99\n%\n"}};

TEST(RenameProgram, WithItsCallersAndItsFile) {
  const Texts due = {{"O0001.nc", "%\nO0001\nM98 P25\nG65 P25 A1.\nM30\n%\n"},
                     {"O0025.nc", "%\nO0025 (HOLE)\nG00 X1.\nM99\n%\n"},
                     {"O0030.nc", "%\nO0030\nM98 P25 L2\nM98 P31\nM30\n%\n"},
                     {"O0031.nc", plates.at("O0031.nc")}};
  EXPECT_EQ(Programs(plates).renamed("fanuc-mill", "O0001.nc", "20", "25"), due) << "at a call";
  EXPECT_EQ(Programs(plates).renamed("fanuc-mill", "O0020.nc", "0020", "25"), due) << "at its head";
}

TEST(RenameProgram, OfANameOrBetweenBrackets) {
  EXPECT_EQ((Programs({{"SHAFT.MPF", "G90\nPART\nM30\n"}, {"PART.SPF", "PROC PART\nG0 X1\nRET\n"}})
                 .renamed("sinumerik", "SHAFT.MPF", "PART", "SIDE")),
            (Texts{{"SHAFT.MPF", "G90\nSIDE\nM30\n"}, {"SIDE.SPF", "PROC SIDE\nG0 X1\nRET\n"}}));
  EXPECT_EQ((Programs({{"main.ngc", "G21\no<hole> call\nM2\n"},
                       {"hole.ngc", "o<hole> sub\nG0 X1\no<hole> endsub\nM2\n"}})
                 .renamed("linuxcnc", "main.ngc", "hole", "bore")),
            (Texts{{"main.ngc", "G21\no<bore> call\nM2\n"},
                   {"bore.ngc", "o<bore> sub\nG0 X1\no<bore> endsub\nM2\n"}}));
}

TEST(RenameProgram, NotToANameThatIsThere) {
  const auto refused = [](llvm::StringRef name, Texts files = plates) {
    const Texts after = Programs(std::move(files)).renamed("fanuc-mill", "O0001.nc", "20", name);
    return after.count("!") ? after.at("!") : "";
  };
  EXPECT_EQ(refused("31"), "there is a program `31` already");
  EXPECT_EQ(refused("abc"), "`abc` is no number");
  EXPECT_EQ(refused("20"), "the program has that name already");
  Texts computed = plates;
  computed["O0030.nc"] = "%\nO0030\nM98 P#1\nM30\n%\n";
  EXPECT_NE(refused("25", computed).find("only the run decides"), std::string::npos)
      << refused("25", computed);
}

TEST(RenameProgram, AProgramFollowsItsFile) {
  EXPECT_EQ(Programs(plates).moved("fanuc-mill", "O0020.nc", "O0025.nc"),
            (Texts{{"O0001.nc", "%\nO0001\nM98 P25\nG65 P25 A1.\nM30\n%\n"},
                   {"O0020.nc", "%\nO0025 (HOLE)\nG00 X1.\nM99\n%\n"},
                   {"O0030.nc", "%\nO0030\nM98 P25 L2\nM98 P31\nM30\n%\n"},
                   {"O0031.nc", plates.at("O0031.nc")}}));
  EXPECT_EQ(Programs(plates).moved("fanuc-mill", "O0020.nc", "O0020.tap"), plates);
  EXPECT_EQ(Programs(plates).moved("fanuc-mill", "O0020.nc", "HOLE.nc"), plates)
      << "it has no number any more: nobody knows which one is meant";
}

const Texts depths = {{"O0001.nc", "%\nO0001\n#102=5.\nM98 P20\nG00 X#102\nM30\n%\n"},
                      {"O0020.nc", "%\nO0020\nG01 Z-#102 (DEPTH) F100.\n#103=1\nM98 P21\nM99\n%\n"},
                      {"O0021.nc", "%\nO0021\nG00 Z[#102+#103]\nM99\n%\n"},
                      {"O0030.nc", "%\nO0030\n#102=7.\nG00 X#102\nM30\n%\n"}};

TEST(RenameShared, InTheProgramsThatCallEachOther) {
  const Texts due = {{"O0001.nc", "%\nO0001\n#110=5.\nM98 P20\nG00 X#110\nM30\n%\n"},
                     {"O0020.nc", "%\nO0020\nG01 Z-#110 (DEPTH) F100.\n#103=1\nM98 P21\nM99\n%\n"},
                     {"O0021.nc", "%\nO0021\nG00 Z[#110+#103]\nM99\n%\n"},
                     {"O0030.nc", depths.at("O0030.nc")}};
  EXPECT_EQ(Programs(depths).shared("fanuc-mill", "O0001.nc", "#102", "110"), due) << "the caller";
  EXPECT_EQ(Programs(depths).shared("fanuc-mill", "O0021.nc", "#102", "110"), due) << "the callee";
}

TEST(RenameShared, ParametersOfAChannel) {
  EXPECT_EQ((Programs({{"SHAFT.MPF", "R5=3\nPART\nM30\n"}, {"PART.SPF", "G0 X=R5\nRET\n"}})
                 .shared("sinumerik", "PART.SPF", "R5", "R7")),
            (Texts{{"SHAFT.MPF", "R7=3\nPART\nM30\n"}, {"PART.SPF", "G0 X=R7\nRET\n"}}));
}

TEST(RenameShared, NotWhereAValueMayComeFromElsewhere) {
  const auto refused = [](const char *file, const char *text, llvm::StringRef name = "110") {
    Texts files = depths;
    files[file] = text;
    const Texts after = Programs(std::move(files)).shared("fanuc-mill", "O0020.nc", "#102", name);
    return after.count("!") ? after.at("!") : "";
  };
  EXPECT_EQ(refused("O0001.nc", "%\nO0001\nM98 P20\n#102=5.\nM30\n%\n"),
            "O0001.nc: `102` is read before it is written: its value comes from elsewhere");
  EXPECT_EQ(refused("O0001.nc", "%\nO0001\n#102=5.\nM98 P20\nM98 P99\nM30\n%\n"),
            "O0001.nc: line 5 calls a program that is not found, which shares `102`");
  EXPECT_EQ(refused("O0001.nc", "%\nO0001\n#102=5.\nM98 P20\n#[#1]=2\nM30\n%\n"),
            "O0001.nc: line 5 names a variable that only the run decides");
  EXPECT_EQ(refused("O0040.nc", "%\nO0040\n#1=20\nM98 P#1\nM30\n%\n"),
            "O0040.nc: line 4 calls a program that only the run decides");
  EXPECT_EQ(refused("O0001.nc", "%\nO0001\nM30\n%\n"),
            "a program that calls this one shares `102`");
  EXPECT_EQ(refused("O0030.nc", depths.at("O0030.nc").c_str(), "103"),
            "`103` is in use already: line 4");
  EXPECT_EQ(refused("O0030.nc", depths.at("O0030.nc").c_str(), "5"),
            "`5` is no other variable that these programs share");
}

} // namespace
