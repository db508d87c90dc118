// Finds called programs in the folders of a control's backup.
#include "tests/support/run_program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace ncvet {
namespace {

/// The folders that an archive of a SINUMERIK unpacks to.
class Backup : public testing::Test {
protected:
  void write(const std::string &name, const std::string &text) const {
    const std::filesystem::path path = folder_.path() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
  }
  std::string path(const std::string &name) const { return (folder_.path() / name).string(); }

  /// The file, from the backup's folder on, of the program that `from` calls by `name`; "?" when it
  /// is one of several, empty when there is none.
  std::string found(const std::string &from, const std::string &name,
                    const std::vector<std::string> &checked = {}) {
    SourceSet sources;
    auto folders = std::make_shared<ProgramFolders>();
    folders->setChecked(checked);
    Project project(sources, test::dialectNamed("sinumerik"), MachineProfile(), {}, folders);
    auto main = sources.open(path(from));
    if (!main) {
      ADD_FAILURE() << llvm::toString(main.takeError());
      return "";
    }
    FileUnit &unit = project.unit(**main);
    const Project::Found program = project.findProgram(unit, name);
    if (program.first)
      return std::filesystem::relative(program.first->source.path(), folder_.path())
          .generic_string();
    return project.liesElsewhere(unit, name) ? "?" : "";
  }

private:
  test::TemporaryFolder folder_;
};

TEST_F(Backup, AProgramOfTheSubprogramsFolderIsFoundFromTheMainProgramsFolder) {
  write("MPF.DIR/MAIN.MPF", "BAR\nM30\n");
  write("SPF.DIR/BAR.SPF", "G0 X10\nM17\n");
  EXPECT_EQ(found("MPF.DIR/MAIN.MPF", "BAR"), "SPF.DIR/BAR.SPF");
  EXPECT_EQ(found("MPF.DIR/MAIN.MPF", "RAB"), "");
}

/// The own folder, then SPF, then the builder's, the user's before those of the maker.
TEST_F(Backup, TheFoldersAreSearchedInTheControlsOrder) {
  write("MPF/MAIN.MPF", "M30\n");
  write("CST.DIR/POS.SPF", "M17\n");
  EXPECT_EQ(found("MPF/MAIN.MPF", "POS"), "CST.DIR/POS.SPF");
  write("CMA.DIR/POS.SPF", "M17\n");
  EXPECT_EQ(found("MPF/MAIN.MPF", "POS"), "CMA.DIR/POS.SPF");
  write("CUS.DIR/POS.SPF", "M17\n");
  EXPECT_EQ(found("MPF/MAIN.MPF", "POS"), "CUS.DIR/POS.SPF");
  write("_N_SPF_DIR/POS.SPF", "M17\n");
  EXPECT_EQ(found("MPF/MAIN.MPF", "POS"), "_N_SPF_DIR/POS.SPF");
  write("MPF/POS.SPF", "M17\n");
  EXPECT_EQ(found("MPF/MAIN.MPF", "POS"), "MPF/POS.SPF");
}

TEST_F(Backup, AWorkpieceFindsTheSubprogramsOfItsControl) {
  write("WKS.DIR/FLANGE.WPD/FLANGE.MPF", "M30\n");
  write("SPF.DIR/BAR.SPF", "M17\n");
  EXPECT_EQ(found("WKS.DIR/FLANGE.WPD/FLANGE.MPF", "BAR"), "SPF.DIR/BAR.SPF");
}

/// The control does not look into other workpieces; the backup is the only hint.
TEST_F(Backup, OneProgramOfTheNameFurtherAwayIsTakenAndOfSeveralNone) {
  write("MPF.DIR/MAIN.MPF", "M30\n");
  write("CMA.DIR/GRIND/BAR.SPF", "M17\n");
  EXPECT_EQ(found("MPF.DIR/MAIN.MPF", "BAR"), "CMA.DIR/GRIND/BAR.SPF");
  write("WKS.DIR/SHAFT.WPD/BAR.SPF", "M17\n");
  EXPECT_EQ(found("MPF.DIR/MAIN.MPF", "BAR"), "?");
}

TEST_F(Backup, FilesThatAreCheckedTogetherFindEachOther) {
  write("parts/MAIN.MPF", "M30\n");
  write("library/BAR.SPF", "M17\n");
  EXPECT_EQ(found("parts/MAIN.MPF", "BAR"), "");
  const std::vector<std::string> checked = {path("parts/MAIN.MPF"), path("library/BAR.SPF")};
  EXPECT_EQ(found("parts/MAIN.MPF", "BAR", checked), "library/BAR.SPF");
}

} // namespace
} // namespace ncvet
