// Programs renamed in all files that name them.
#include "lsp/features/writing/rename_program.h"
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

} // namespace
