// `ncvet check --watch` as a process: what makes it check again, what it prints, how it ends.
#include "tests/support/places.h"
#include "tests/support/process.h"

#include "gtest/gtest.h"
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace ncvet::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

using Clock = std::chrono::steady_clock;

std::string programWithFeed() {
  std::string text = programWithoutFeed();
  text.replace(text.find("Z-5."), 4, "Z-5. F0.2");
  return text;
}

/// Writes a file in one step: no half of it is seen.
void replace(const Shop &shop, const std::string &name, const std::string &text) {
  const auto path = shop.path() / name, half = shop.path() / ".half";
  std::ofstream(half, std::ios::binary) << text;
  std::filesystem::rename(half, path);
}

/// A watch that runs in a folder of its own while a test changes the folder.
class RunningWatch {
public:
  RunningWatch(const Shop &shop, std::vector<std::string> arguments) {
    // A build that runs in the background has made its children deaf to it.
    std::signal(SIGINT, SIG_DFL);
    std::vector<std::string> words = {
        "env",     "-C",        shop.path().string(), places::program(), "check",
        "--watch", "--dialect", "haas-lathe",         "--select",        "feed-missing"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const std::vector<llvm::StringRef> views(words.begin(), words.end());
    const llvm::Optional<llvm::StringRef> streams[] = {
        llvm::StringRef("/dev/null"), llvm::StringRef(out_), llvm::StringRef(err_)};
    process_ =
        llvm::sys::ExecuteNoWait(*llvm::sys::findProgramByName("env"), views, llvm::None, streams);
  }
  ~RunningWatch() {
    if (process_.Pid)
      interrupt();
  }
  RunningWatch(const RunningWatch &) = delete;

  std::string out() const { return contents(out_); }
  std::string err() const { return contents(err_); }

  /// Waits until so many reports were written.
  bool reports(size_t wanted) const {
    return within(std::chrono::seconds(20), [&] { return count("watching ") >= wanted; });
  }
  /// Whether no further report comes: for longer than the watch waits between two looks.
  bool staysAt(size_t reports) const {
    return !within(std::chrono::milliseconds(1500), [&] { return count("watching ") > reports; });
  }

  /// Ctrl-C; the exit code.
  int interrupt() {
    ::kill(process_.Pid, SIGINT);
    const llvm::sys::ProcessInfo ended =
        llvm::sys::Wait(process_, 20, /*WaitUntilTerminates=*/false);
    process_.Pid = 0;
    return ended.ReturnCode;
  }

private:
  static std::string contents(const std::string &path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  size_t count(llvm::StringRef what) const { return llvm::StringRef(err()).count(what); }

  template <typename Holds>
  static bool within(std::chrono::milliseconds time, Holds holds) {
    for (const Clock::time_point end = Clock::now() + time; Clock::now() < end;) {
      if (holds())
        return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return holds();
  }

  TemporaryFolder logs_;
  const std::string out_ = (logs_.path() / "out").string(), err_ = (logs_.path() / "err").string();
  llvm::sys::ProcessInfo process_;
};

TEST(Watch, ReportsAgainAfterAChangeAndEndsWithTheLastExitCode) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  RunningWatch watch(shop, {"a.nc"});
  ASSERT_TRUE(watch.reports(1)) << watch.err();
  EXPECT_THAT(watch.out(), HasSubstr("a.nc:4:"));
  EXPECT_THAT(watch.err(), EndsWith("watching 1 file; Ctrl-C ends it\n"));
  replace(shop, "a.nc", programWithFeed());
  ASSERT_TRUE(watch.reports(2)) << watch.err();
  EXPECT_THAT(watch.err(), HasSubstr("changed: a.nc\nno findings in 1 file, 5 blocks\n"));
  EXPECT_EQ(0, watch.interrupt());
}

TEST(Watch, EndsWithOneWhenTheLastCheckFoundSomething) {
  Shop shop;
  shop.file("a.nc", programWithFeed());
  RunningWatch watch(shop, {"."});
  ASSERT_TRUE(watch.reports(1)) << watch.err();
  replace(shop, "a.nc", programWithoutFeed());
  ASSERT_TRUE(watch.reports(2)) << watch.err();
  EXPECT_THAT(watch.out(), HasSubstr("[feed-missing]"));
  EXPECT_EQ(1, watch.interrupt());
}

TEST(Watch, SeesProgramsThatComeAndGoInTheFolder) {
  Shop shop;
  shop.file("a.nc", programWithFeed()).file("below/b.nc", programWithFeed());
  RunningWatch watch(shop, {"."});
  ASSERT_TRUE(watch.reports(1)) << watch.err();
  replace(shop, "below/c.nc", programWithoutFeed());
  ASSERT_TRUE(watch.reports(2)) << watch.err();
  EXPECT_THAT(watch.out(), StartsWith("below/c.nc:4:"));
  std::filesystem::remove(shop.path() / "below" / "c.nc");
  ASSERT_TRUE(watch.reports(3)) << watch.err();
  EXPECT_THAT(watch.err(), HasSubstr("no findings in 2 files"));
  EXPECT_EQ(0, watch.interrupt());
}

TEST(Watch, SeesAProgramThatIsCalledFromAnotherFolder) {
  Shop shop;
  shop.file("parts/a.nc", "O0001\nT101\nG97 S800 M03\nM98 P8000\nG00 X100. M05\nM30\n")
      .file("library/O8000.nc", "O8000\nG01 X20. Z-5. F0.2\nM99\n")
      .file("parts/.ncvet.json", "{\"searchFolders\": [\"../library\"]}");
  RunningWatch watch(shop, {"parts/a.nc"});
  ASSERT_TRUE(watch.reports(1)) << watch.err();
  EXPECT_EQ("", watch.out());
  replace(shop, "library/O8000.nc", "O8000\nG01 X20. Z-5.\nM99\n");
  ASSERT_TRUE(watch.reports(2)) << watch.err();
  EXPECT_THAT(watch.out(), HasSubstr("library/O8000.nc:2:"));
  EXPECT_EQ(1, watch.interrupt());
}

TEST(Watch, ANewConfigurationCounts) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  RunningWatch watch(shop, {"."});
  ASSERT_TRUE(watch.reports(1)) << watch.err();
  replace(shop, ".ncvet.json", "{\"exclude\": [\"a.nc\"]}");
  ASSERT_TRUE(watch.reports(2)) << watch.err();
  EXPECT_THAT(watch.err(), HasSubstr("no programs in ."));
  EXPECT_EQ(0, watch.interrupt());
}

TEST(Watch, GoesOnWithAMachineProfileThatCannotBeReadForAWhile) {
  Shop shop;
  shop.file("a.nc", programWithFeed()).file("lathe.json", "{\"dialect\": \"haas-lathe\"}");
  RunningWatch watch(shop, {"--machine", "lathe.json", "a.nc"});
  ASSERT_TRUE(watch.reports(1)) << watch.err();
  replace(shop, "lathe.json", "{\"dialect\": ");
  ASSERT_TRUE(watch.reports(2)) << watch.err();
  EXPECT_THAT(watch.err(), HasSubstr("ncvet: error: lathe.json"));
  replace(shop, "lathe.json", "{\"dialect\": \"haas-lathe\"}");
  ASSERT_TRUE(watch.reports(3)) << watch.err();
  EXPECT_EQ(0, watch.interrupt());
}

TEST(Watch, ItsOwnReportsAreNoChanges) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  RunningWatch watch(shop, {"--report", "json:report.json", "."});
  ASSERT_TRUE(watch.reports(1)) << watch.err();
  EXPECT_TRUE(watch.staysAt(1)) << watch.err();
  replace(shop, "a.nc", programWithFeed());
  ASSERT_TRUE(watch.reports(2)) << watch.err();
  EXPECT_THAT(shop.text("report.json"), HasSubstr("\"findings\":0"));
  EXPECT_TRUE(watch.staysAt(2)) << watch.err();
}

TEST(Watch, PathsMayBeShownRelativeToAnotherFolder) {
  Shop shop;
  shop.file("parts/a.nc", programWithoutFeed()).file("lathe.json", "{\"dialect\": \"haas-lathe\"}");
  RunningWatch watch(shop, {"--relative-to", "parts", "--machine", "lathe.json", "parts/a.nc"});
  ASSERT_TRUE(watch.reports(1)) << watch.err();
  EXPECT_THAT(watch.out(), StartsWith("a.nc:4:"));
  replace(shop, "parts/a.nc", programWithFeed());
  ASSERT_TRUE(watch.reports(2)) << watch.err();
  replace(shop, "lathe.json", "{\"dialect\": \"haas-lathe\" }");
  ASSERT_TRUE(watch.reports(3)) << watch.err();
  EXPECT_EQ(0, watch.interrupt());
}

TEST(Watch, WritesReportsForProgramsOnlyOnStandardOutput) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  RunningWatch watch(shop, {"--format", "jsonl", "a.nc"});
  EXPECT_TRUE(watch.staysAt(0));
  EXPECT_EQ("", watch.err());
  EXPECT_THAT(watch.out(), HasSubstr("feed-missing"));
}

TEST(Watch, IsRefusedWhereThereIsNothingToWatch) {
  Shop shop;
  shop.file("a.nc", programWithFeed());
  EXPECT_THAT(shop.run({"check", "--watch", "-"}).err,
              HasSubstr("--watch and - exclude each other"));
  for (const char *option : {"--fix", "--diff", "--write-baseline=known.json"}) {
    const ProcessResult result = shop.run({"check", "--watch", option, "a.nc"});
    EXPECT_EQ(2, result.exitCode);
    EXPECT_THAT(result.err, HasSubstr("--watch goes with neither --fix")) << option;
  }
  const ProcessResult wrong = shop.run({"check", "--watch", "--machine", "none.json", "a.nc"});
  EXPECT_EQ(2, wrong.exitCode);
  EXPECT_THAT(wrong.err, Not(HasSubstr("watching")));
}

} // namespace
} // namespace ncvet::test
