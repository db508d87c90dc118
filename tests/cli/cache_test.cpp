// Outcomes that `ncvet check` keeps: what is not checked again, and after which changes it is.
#include "tests/support/process.h"

#include "gtest/gtest.h"
#include <gmock/gmock.h>

namespace ncvet::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A folder whose checks keep what they find.
class CacheTest : public ::testing::Test {
protected:
  ProcessResult check(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"check", "--stats", "--format", "json"});
    return shop.run(arguments);
  }
  /// How many of the files a check did not check again.
  static std::string known(const ProcessResult &result) {
    const llvm::StringRef last = llvm::StringRef(result.err).rsplit(" fixes, ").second;
    return last.contains(" known, ") ? last.split(" known, ").first.str() : "0";
  }

  Shop shop;
};

const std::string callingProgram = "O0001\nT101\nG97 S800 M03\nM98 P8000\nG00 X100. M05\nM30\n";
const std::string calledProgram = "O8000\nG01 X20. Z-5.\nM99\n";

TEST_F(CacheTest, ASecondCheckKnowsWhatTheFirstOneFound) {
  shop.file("a.nc", programWithoutFeed())
      .file("b.nc", callingProgram)
      .file("O8000.nc", calledProgram);
  const ProcessResult first = check({"."}), second = check({"."});
  EXPECT_EQ("0", known(first)) << first.err;
  EXPECT_EQ("3", known(second)) << second.err;
  EXPECT_EQ(first.out, second.out);
  EXPECT_EQ(first.exitCode, second.exitCode);
  EXPECT_THAT(second.out, HasSubstr("feed-missing"));
  const ProcessResult none = check({"--no-cache", "."});
  EXPECT_EQ("0", known(none));
  EXPECT_EQ(first.out, none.out);
}

TEST_F(CacheTest, ATextThatChangesIsCheckedAgain) {
  shop.file("a.nc", programWithoutFeed()).file("b.nc", "O0002\nG54\nM30\n");
  check({"."});
  // Of the same length, and it may be within the same moment.
  std::string other = programWithoutFeed();
  other.replace(other.find("X20."), 4, "X21.");
  shop.file("a.nc", other);
  const ProcessResult changed = check({"."});
  EXPECT_EQ("1", known(changed)) << changed.err;
  EXPECT_EQ(shop.run({"check", "--no-cache", "--format", "json", "."}).out, changed.out);
}

TEST_F(CacheTest, ACalledProgramThatChangesCounts) {
  shop.file("parts/a.nc", callingProgram).file("library/O8000.nc", calledProgram);
  shop.file(".ncvet.json", "{\"searchFolders\": [\"library\"]}");
  EXPECT_THAT(check({"parts"}).out, HasSubstr("feed-missing"));
  EXPECT_EQ("1", known(check({"parts"})));
  shop.file("library/O8000.nc", "O8000\nG01 X20. Z-5. F0.2\nM99\n");
  const ProcessResult changed = check({"parts"});
  EXPECT_EQ("0", known(changed));
  EXPECT_THAT(changed.out, Not(HasSubstr("feed-missing")));
}

TEST_F(CacheTest, AProgramThatWasNotThereCounts) {
  shop.file("a.nc", callingProgram);
  const ProcessResult without = check({"a.nc"});
  EXPECT_EQ(without.out, check({"a.nc"}).out);
  shop.file("O8000.nc", calledProgram);
  const ProcessResult with = check({"a.nc"});
  EXPECT_EQ("0", known(with));
  EXPECT_THAT(with.out, HasSubstr("O8000.nc"));
  std::filesystem::remove(shop.path() / "O8000.nc");
  EXPECT_EQ(without.out, check({"a.nc"}).out);
}

TEST_F(CacheTest, ACallerThatIsNewCounts) {
  // A subprogram is checked with what its callers hand over.
  shop.file("O8000.nc", calledProgram);
  check({"O8000.nc"});
  shop.file("a.nc", callingProgram);
  const ProcessResult called = check({"O8000.nc"});
  EXPECT_EQ(shop.run({"check", "--no-cache", "--format", "json", "O8000.nc"}).out, called.out);
}

TEST_F(CacheTest, OptionsAndConfigurationsCount) {
  shop.file("a.nc", programWithoutFeed());
  check({"a.nc"});
  EXPECT_EQ("0", known(check({"--ignore", "feed", "a.nc"})));
  EXPECT_EQ("0", known(check({"--dialect", "fanuc-0t", "a.nc"})));
  EXPECT_EQ("1", known(check({"a.nc"})));
  shop.file(".ncvet.json", "{\"rules\": {\"ignore\": [\"feed-missing\"]}}");
  const ProcessResult ignored = check({"a.nc"});
  EXPECT_EQ("0", known(ignored));
  EXPECT_THAT(ignored.out, Not(HasSubstr("feed-missing")));
}

TEST_F(CacheTest, TablesOfOnesOwnAndMachineProfilesCount) {
  shop.file("a.nc", programWithoutFeed())
      .file("own.json", "{\"id\": \"own\", \"title\": \"Own\", \"extends\": \"haas-lathe\"}")
      .file("lathe.json", "{\"dialect\": \"haas-lathe\"}");
  for (const std::vector<std::string> &options :
       {std::vector<std::string>{"--dialect", "own.json", "a.nc"},
        std::vector<std::string>{"--machine", "lathe.json", "a.nc"}}) {
    check(options);
    EXPECT_EQ("1", known(check(options))) << check(options).err;
  }
  shop.file("own.json", "{\"id\": \"own\", \"title\": \"Own\", \"extends\": \"haas-lathe\" }");
  shop.file("lathe.json", "{\"dialect\": \"haas-lathe\" }");
  EXPECT_EQ("0", known(check({"--dialect", "own.json", "a.nc"})));
  EXPECT_EQ("0", known(check({"--machine", "lathe.json", "a.nc"})));
}

TEST_F(CacheTest, WhatIsDamagedIsCheckedAgain) {
  shop.file("a.nc", programWithoutFeed());
  const std::vector<std::string> options = {"--cache-dir", "kept", "a.nc"};
  const std::string first = check(options).out;
  size_t files = 0;
  for (const auto &entry : std::filesystem::directory_iterator(shop.path() / "kept"))
    if (std::filesystem::file_size(entry) > 100) {
      ++files;
      std::filesystem::resize_file(entry, std::filesystem::file_size(entry) - 1);
    }
  EXPECT_EQ(1u, files);
  const ProcessResult again = check(options);
  EXPECT_EQ("0", known(again));
  EXPECT_EQ(first, again.out);
  EXPECT_EQ("1", known(check(options)));
}

TEST_F(CacheTest, AFolderThatCannotBeWrittenIsNoFailure) {
  shop.file("a.nc", programWithoutFeed()).file("kept", "a file");
  const ProcessResult result =
      check({"--dialect", "haas-lathe", "--cache-dir", "kept/below", "a.nc"});
  EXPECT_EQ(1, result.exitCode) << result.err;
  EXPECT_EQ("0", known(result));
}

} // namespace
} // namespace ncvet::test
