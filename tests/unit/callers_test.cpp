// Who calls a program: in its file, in the files beside it, in the folders of an archive.
#include "analyzer/program/callers.h"
#include "tests/support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

using test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A folder of programs, and who calls the first program of `file` there: "MAIN.nc:7".
class Store {
public:
  Store &file(const std::string &name, const std::string &text) {
    const auto path = folder_.path() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return *this;
  }
  template <typename Ask>
  auto ask(const std::string &dialect, const std::string &file, Ask what) {
    SourceSet sources;
    const auto folders = std::make_shared<ProgramFolders>();
    folders->setChecked(checked_);
    Project project(sources, test::dialectNamed(dialect), MachineProfile(), {}, folders);
    FileUnit *const unit = project.open((folder_.path() / file).string());
    EXPECT_NE(nullptr, unit);
    return what(*unit);
  }
  /// All files so far are checked together.
  Store &together() {
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder_.path()))
      if (entry.is_regular_file())
        checked_.push_back(entry.path().string());
    return *this;
  }
  std::vector<std::string> callers(const std::string &dialect, const std::string &file) {
    return ask(dialect, file, [](FileUnit &unit) {
      std::vector<std::string> lines;
      for (const CallPlace &call : callersOf(unit, unit.index.programs().front()).places)
        lines.push_back(std::filesystem::path(call.unit->source.path()).filename().string() + ":" +
                        std::to_string(call.unit->source.lines().lineOf(call.block)));
      return lines;
    });
  }
  std::vector<std::string> uncalled(const std::string &dialect, const std::string &file) {
    return ask(dialect, file, [](FileUnit &unit) {
      std::vector<std::string> names;
      for (const std::string &path : uncalledFilesBeside(unit))
        names.push_back(std::filesystem::path(path).filename().string());
      return names;
    });
  }

private:
  TemporaryFolder folder_;
  std::vector<std::string> checked_;
};

TEST(Callers, AreFoundInTheFilesBeside) {
  Store store;
  store.file("O1.nc", "O1\nG0 X0\nM98 P20\nM30\n")
      .file("O2.nc", "O2\nM98 P20\nM98 P30\nM30\n")
      .file("O20.nc", "O20\nG1 X5.\nM99\n");
  EXPECT_THAT(store.callers("fanuc-mill", "O20.nc"), ElementsAre("O1.nc:3", "O2.nc:2"));
}

TEST(Callers, AreFoundByNameInTheFoldersOfAnArchive) {
  Store store;
  store.file("MPF.DIR/PLATE.MPF", "N10 G0 X0\nN20 SLOT\nN30 M30\n")
      .file("SPF.DIR/SLOT.SPF", "N10 G1 X5\nN20 M17\n");
  EXPECT_THAT(store.callers("sinumerik", "SPF.DIR/SLOT.SPF"), ElementsAre("PLATE.MPF:2"));
}

TEST(Callers, AreFoundInOtherFoldersThatAreCheckedTogether) {
  Store store;
  store.file("main/O1.nc", "O1\nM98 P20\nM30\n").file("lib/O20.nc", "O20\nG1 X5.\nM99\n");
  EXPECT_THAT(store.callers("fanuc-mill", "lib/O20.nc"), IsEmpty());
  store.together();
  EXPECT_THAT(store.callers("fanuc-mill", "lib/O20.nc"), ElementsAre("O1.nc:2"));
}

TEST(Callers, OfAProgramThatTwoOfTheseFoldersHaveAreNotKnown) {
  Store store;
  store.file("main/O1.nc", "O1\nM98 P20\nM30\n")
      .file("lib/O20.nc", "O20\nG1 X5.\nM99\n")
      .file("old/O20.nc", "O20\nG1 X4.\nM99\n")
      .together();
  EXPECT_TRUE(store.ask("fanuc-mill", "main/O1.nc", [](FileUnit &unit) {
    return unit.project->findProgram(unit, 20).second == nullptr;
  }));
}

TEST(Callers, OfAnotherProgramOfTheSameNumberDoNotCount) {
  Store store;
  store.file("O1.nc", "O1\nM98 P20\nM30\nO20\nM99\n").file("O20.nc", "O20\nG1 X5.\nM99\n");
  EXPECT_THAT(store.callers("fanuc-mill", "O20.nc"), IsEmpty());
}

TEST(Callers, ASubprogramWithoutAnyIsNamed) {
  Store store;
  store.file("O1.nc", "O1\nM98 P20\nM30\n")
      .file("O20.nc", "O20\nG1 X5.\nM99\n")
      .file("O21.nc", "O21\nG1 X5.\nM99\n");
  EXPECT_THAT(store.uncalled("fanuc-mill", "O1.nc"), ElementsAre("O21.nc"));
}

TEST(Callers, WhereOneIsComputedNoneIsNamedAsWithout) {
  Store store;
  store.file("O1.nc", "O1\nM98 P#1\nM30\n").file("O21.nc", "O21\nG1 X5.\nM99\n");
  EXPECT_THAT(store.uncalled("fanuc-mill", "O1.nc"), IsEmpty());
}

} // namespace
} // namespace ncvet
