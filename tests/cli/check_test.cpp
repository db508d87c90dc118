// `ncvet check` as a process: exit codes, inputs, reports, rules, baseline, fixes.
#include "tests/support/process.h"

#include "gtest/gtest.h"
#include <gmock/gmock.h>

namespace ncvet::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

const std::vector<std::string> feedOnly = {"--dialect", "haas-lathe", "--select", "feed-missing"};

std::vector<std::string> with(std::vector<std::string> arguments,
                              const std::vector<std::string> &more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// `check` with the feed rule alone.
std::vector<std::string> check(const std::vector<std::string> &more) {
  return with(with({"check"}, feedOnly), more);
}

std::string goodProgram() {
  std::string text = programWithoutFeed();
  text.replace(text.find("Z-5."), 4, "Z-5. F0.2");
  return text;
}

TEST(CheckCommand, ExitsWithZeroWhenNothingIsFound) {
  Shop shop;
  shop.file("a.nc", goodProgram());
  const ProcessResult result = shop.run(check({"a.nc"}));
  EXPECT_EQ(0, result.exitCode) << result.err;
  EXPECT_EQ("", result.out);
  EXPECT_EQ("no findings in 1 file, 5 blocks\n", result.err);
}

TEST(CheckCommand, SaysInOneLineWhichControlWasGuessed) {
  Shop shop;
  shop.file("a.nc", goodProgram());
  shop.file("b.mpf", "G54 G17 G90\nT1 D1 M6\nM30\n");
  const ProcessResult one = shop.run({"check", "a.nc"});
  EXPECT_THAT(one.err, StartsWith("control: "));
  EXPECT_THAT(one.err, HasSubstr(", guessed: "));
  EXPECT_THAT(one.err, HasSubstr("; --dialect names it\n"));
  EXPECT_EQ(2, std::count(one.err.begin(), one.err.end(), '\n')) << one.err;
  const ProcessResult two = shop.run({"check", "a.nc", "b.mpf"});
  EXPECT_THAT(two.err, StartsWith("control: guessed for 2 files: "));
  EXPECT_EQ(2, std::count(two.err.begin(), two.err.end(), '\n')) << two.err;
  EXPECT_THAT(shop.run({"check", "--dialect", "haas-lathe", "a.nc"}).err,
              Not(HasSubstr("control: ")));
  EXPECT_EQ("", shop.run({"check", "--quiet", "a.nc"}).err);
}

TEST(CheckCommand, AGuessIsAFieldOfTheJsonReport) {
  Shop shop;
  shop.file("b.mpf", "G54 G17 G90\nT1 D1 M6\nM30\n");
  const ProcessResult guessed = shop.run({"check", "--format", "json", "b.mpf"});
  EXPECT_EQ("", guessed.err);
  EXPECT_THAT(guessed.out, HasSubstr("\"guess\":{\"sure\":true,\"from\":"));
  EXPECT_THAT(shop.run({"check", "--format", "json", "--dialect", "sinumerik", "b.mpf"}).out,
              HasSubstr("\"guess\":null"));
}

TEST(CheckCommand, SaysInOneLineWhatCouldNotBeFollowedToTheEnd) {
  std::string program = "%\nO1\nG21 G90 G54\nS100 M3\nGOTO #100\n";
  for (unsigned i = 1; i < 100; ++i)
    program += "N" + std::to_string(i) + " G1 X" + std::to_string(i) + ". F100.\n";
  Shop shop;
  shop.file("a.nc", program + "M30\n%\n");
  const ProcessResult one = shop.run({"check", "--dialect", "fanuc-mill", "a.nc"});
  EXPECT_THAT(one.err, HasSubstr("a.nc: cut short, findings may be missing: a computed jump may "
                                 "lead to too many blocks\n"));
  shop.file("b.nc", program + "M30\n%\n");
  EXPECT_THAT(shop.run({"check", "--dialect", "fanuc-mill", "a.nc", "b.nc"}).err,
              HasSubstr("cut short, findings may be missing: 2 files; --stats names them\n"));
}

TEST(CheckCommand, ExitsWithOneWhenSomethingIsFound) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  const ProcessResult result = shop.run(check({"a.nc"}));
  EXPECT_EQ(1, result.exitCode);
  EXPECT_THAT(result.out, StartsWith("a.nc:4:"));
  EXPECT_THAT(result.out, HasSubstr("[feed-missing]"));
}

TEST(CheckCommand, FailOnChoosesTheLevelThatFails) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  const auto exitCode = [&](const std::string &severity, const std::string &level) {
    return shop.run(check({"--severity", "feed-missing=" + severity, "--fail-on", level, "a.nc"}))
        .exitCode;
  };
  EXPECT_EQ(1, exitCode("error", "error"));
  EXPECT_EQ(0, exitCode("warning", "error"));
  EXPECT_EQ(1, exitCode("warning", "warning"));
  EXPECT_EQ(0, exitCode("style", "warning"));
  EXPECT_EQ(1, exitCode("style", "style"));
  EXPECT_EQ(0, exitCode("error", "never"));
}

TEST(CheckCommand, UnreadableFileIsSaidInOneLineAndTheOthersAreChecked) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  const ProcessResult result = shop.run(check({"missing.nc", "a.nc"}));
  EXPECT_EQ(2, result.exitCode);
  EXPECT_EQ("ncvet: error: cannot read missing.nc: No such file or directory\n"
            "1 finding in 1 of 1 file: 1 error\n",
            result.err);
  EXPECT_THAT(result.out, HasSubstr("a.nc:4:"));
}

TEST(CheckCommand, WrongUsageIsSaidInOneLine) {
  const struct {
    std::vector<std::string> arguments;
    const char *said;
  } cases[] = {
      {{"chek"}, "did you mean \"check\""},
      {{"check", "--formt", "json"}, "--format"},
      {{"check", "--format", "jsn"}, "did you mean \"json\""},
      {{"check", "--fail-on", "sometimes"}, "one of error, warning, style, never"},
      {{"check", "--severity", "feed-missing=loud"}, "error, warning or style"},
      {{"check", "--severity", "feed-missing"}, "RULE=LEVEL"},
      {{"check", "--select", "feed-mising"}, "did you mean \"feed-missing\""},
      {{"check", "--profile", "strikt"}, "did you mean \"strict\""},
      {{"check", "--report", "json"}, "FMT:FILE"},
      {{"check", "--dialect", "haas-lath", "a.nc"}, "haas-lath"},
      {{"check", "--config", "none.json", "a.nc"}, "none.json"},
      {{"check", "--machine", "none.json", "a.nc"}, "none.json"},
      {{"check", "--baseline", "none.json", "a.nc"}, "none.json"},
      {{"check", "--color", "red", "a.nc"}, "one of auto, always, never"},
      {{"explain", "feed-mising"}, "did you mean \"feed-missing\""},
      {{"trace", "none.nc"}, "none.nc"},
      {{"trace"}, "ncvet trace wants a FILE; see `ncvet trace --help`"},
  };
  Shop shop;
  shop.file("a.nc", goodProgram());
  for (const auto &c : cases) {
    const ProcessResult result = shop.run(c.arguments);
    SCOPED_TRACE(::testing::PrintToString(c.arguments));
    EXPECT_EQ(2, result.exitCode);
    EXPECT_THAT(result.err, StartsWith("ncvet: error: "));
    EXPECT_THAT(result.err, HasSubstr(c.said));
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
  }
}

TEST(CheckCommand, JsonHasTheFixedForm) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  const ProcessResult result = shop.run(check({"--format", "json", "a.nc"}));
  const auto json = nlohmann::json::parse(result.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << result.out;
  EXPECT_EQ(1, json["version"]);
  EXPECT_EQ("ncvet", json["tool"]["name"]);
  ASSERT_EQ(1u, json["files"].size());
  EXPECT_EQ("a.nc", json["files"][0]["path"]);
  EXPECT_EQ("haas-lathe", json["files"][0]["dialect"]);
  EXPECT_EQ(5, json["files"][0]["blocks"]); // the header is none
  EXPECT_EQ(true, json["files"][0]["complete"]);
  ASSERT_EQ(1u, json["findings"].size());
  const auto &finding = json["findings"][0];
  EXPECT_EQ("feed-missing", finding["rule"]);
  EXPECT_EQ("error", finding["severity"]);
  EXPECT_EQ("definite", finding["certainty"]);
  EXPECT_EQ(4, finding["line"]);
  EXPECT_EQ(16u, finding["fingerprint"].get<std::string>().size());
  EXPECT_NE("0000000000000000", finding["fingerprint"]);
}

TEST(CheckCommand, FurtherReportsAreWrittenToFiles) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  const ProcessResult result =
      shop.run(check({"--report", "json:out.json", "--report", "sarif:out.sarif", "a.nc"}));
  EXPECT_EQ(1, result.exitCode);
  EXPECT_THAT(result.out, StartsWith("a.nc:4:"));
  EXPECT_EQ(1u, nlohmann::json::parse(shop.text("out.json"), nullptr, false)["findings"].size());
  EXPECT_EQ("2.1.0", nlohmann::json::parse(shop.text("out.sarif"), nullptr, false)["version"]);
}

TEST(CheckCommand, ReportThatCannotBeWrittenIsAFailure) {
  Shop shop;
  shop.file("a.nc", goodProgram());
  const ProcessResult result = shop.run(check({"--report", "json:no/folder/out.json", "a.nc"}));
  EXPECT_EQ(2, result.exitCode);
  EXPECT_THAT(result.err, HasSubstr("cannot write no/folder/out.json"));
}

TEST(CheckCommand, FoldersAreWalkedInOrderForProgramsOnly) {
  Shop shop;
  const std::string program = programWithoutFeed();
  shop.file("b/z.nc", program).file("b/a.NC", program).file("a/O0100", program);
  shop.file("a/notes.txt", "Call the customer about the drawing.\nThen order steel.\n");
  shop.file("a/program.txt", program).file("a/part.step", program);
  shop.file(".hidden/x.nc", program).file("a/.x.nc", program);
  EXPECT_THAT(shop.findings(feedOnly),
              ElementsAre("a/O0100:4 feed-missing", "a/program.txt:4 feed-missing",
                          "b/a.NC:4 feed-missing", "b/z.nc:4 feed-missing"));
  EXPECT_THAT(
      shop.findings(with(feedOnly, {"b", "a/part.step", "b/z.nc"})),
      ElementsAre("a/part.step:4 feed-missing", "b/a.NC:4 feed-missing", "b/z.nc:4 feed-missing"));
}

TEST(CheckCommand, OutputIsTheSameWithAnyNumberOfJobs) {
  Shop shop;
  for (int i = 0; i < 40; ++i)
    shop.file("part" + std::to_string(i) + ".nc",
              (i % 3 ? programWithoutFeed() : goodProgram()) + "(" + std::to_string(i) + ")\n");
  for (const char *format : {"text", "json", "sarif"}) {
    const auto run = [&](const char *jobs) {
      return shop.run({"check", "--profile", "all", "--format", format, "--jobs", jobs}).out;
    };
    const std::string one = run("1");
    EXPECT_THAT(one, HasSubstr("part1.nc"));
    EXPECT_EQ(one, run("2"));
    EXPECT_EQ(one, run("7"));
  }
}

TEST(CheckCommand, StandardInputIsCheckedUnderItsName) {
  Shop shop;
  const ProcessResult named =
      shop.run(check({"--stdin-filename", "sub/a.nc", "-"}), programWithoutFeed());
  EXPECT_EQ(1, named.exitCode);
  EXPECT_THAT(named.out, StartsWith("sub/a.nc:4:"));
  const ProcessResult unnamed = shop.run(check({"-"}), programWithoutFeed());
  EXPECT_THAT(unnamed.out, StartsWith("<stdin>:4:"));
}

TEST(CheckCommand, CategoriesNameTheirRules) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  EXPECT_THAT(shop.findings({"--dialect", "haas-lathe", "--select", "feed", "a.nc"}),
              ElementsAre("a.nc:4 feed-missing"));
  EXPECT_THAT(shop.findings({"--dialect", "haas-lathe", "--select", "feed", "--ignore",
                             "feed-missing", "a.nc"}),
              IsEmpty());
}

TEST(CheckCommand, SubprogramOfTheFolderIsFoundAndReportedOnce) {
  Shop shop;
  shop.file("main.nc", "O0001\nT101\nG97 S800 M03\nM98 P1000\nM98 P1000\nM30\n");
  shop.file("main2.nc", "O0002\nT101\nG97 S800 M03\nM98 P1000\nM30\n");
  shop.file("O1000.nc", "O1000\nG01 X10. Z-5.\nM99\n");
  EXPECT_THAT(shop.findings(feedOnly), ElementsAre("O1000.nc:2 feed-missing"));
}

TEST(CheckCommand, StatsSayWhyADialectWasChosen) {
  Shop shop;
  shop.file("a.nc", goodProgram());
  const ProcessResult given = shop.run(check({"--stats", "a.nc"}));
  EXPECT_THAT(given.err, HasSubstr("a.nc: haas-lathe (--dialect), 5 blocks"));
  shop.file(".ncvet.json", R"({"dialect": "haas-lathe"})");
  EXPECT_THAT(shop.run({"check", "--stats", "a.nc"}).err, HasSubstr("haas-lathe (.ncvet.json)"));
}

/// A slot of 10 mm: its bottom lies between two inside corners.
TEST(CheckCommand, StatsTellUpToWhichRadiusAContourStaysWhole) {
  Shop shop;
  shop.file("a.nc", "O1204\nG17 G21 G90 G40\nT1 M6\nG0 X5. Y45.\nG1 G41 X0. Y30. D1 F300.\n"
                    "Y0.\nX10.\nY30.\nG40 X5. Y45.\nM30\n");
  EXPECT_THAT(shop.run({"check", "--dialect", "fanuc-0m", "--stats", "a.nc"}).err,
              HasSubstr("a.nc:5: contour on the left, 3 elements, safe up to R5.00"));
}

TEST(CheckCommand, ColorsAreGivenWhenAskedFor) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  EXPECT_THAT(shop.run(check({"--color=always", "a.nc"})).out, HasSubstr("\x1b["));
  EXPECT_THAT(shop.run(check({"a.nc"})).out, Not(HasSubstr("\x1b[")));
}

TEST(CheckSuppression, CommentOnTheBlockOrAboveSilencesIt) {
  Shop shop;
  std::string on = programWithoutFeed(), above = on;
  on.replace(on.find("Z-5."), 4, "Z-5. (ncvet: allow feed-missing -- bar feeder)");
  above.replace(above.find("G01"), 3, "(NCVET: ALLOW FEED-MISSING)\nG01");
  shop.file("on.nc", on).file("above.nc", above);
  EXPECT_THAT(shop.findings(
                  {"--dialect", "haas-lathe", "--select", "feed-missing,style-unused-suppression"}),
              IsEmpty());
  const ProcessResult sarif = shop.run(check({"--format", "sarif", "on.nc"}));
  EXPECT_EQ(0, sarif.exitCode);
  EXPECT_THAT(sarif.out, HasSubstr("\"suppressions\""));
}

TEST(CheckSuppression, CommentThatSuppressesNothingIsReportedOnlyForRulesThatRan) {
  Shop shop;
  std::string text = goodProgram();
  text.replace(text.find("M30"), 3, "(ncvet: allow feed-missing)\nM30");
  shop.file("a.nc", text);
  EXPECT_THAT(shop.findings(
                  {"--dialect", "haas-lathe", "--select", "feed-missing,style-unused-suppression"}),
              ElementsAre("a.nc:6 style-unused-suppression"));
  EXPECT_THAT(shop.findings({"--dialect", "haas-lathe", "--select", "style-unused-suppression"}),
              IsEmpty());
}

TEST(CheckSuppression, CommentInASubprogramMayBeNeededByItsCaller) {
  Shop shop;
  shop.file("main.nc", "O0001\nT101\nG97 S800 M03\nM98 P1000\nM30\n");
  shop.file("O1000.nc", "O1000\n(ncvet: allow feed-missing)\nG01 X10. Z-5.\nM99\n");
  EXPECT_THAT(shop.findings(
                  {"--dialect", "haas-lathe", "--select", "feed-missing,style-unused-suppression"}),
              IsEmpty());
}

TEST(CheckBaseline, KnownFindingsAreNotToldAgainAndNewOnesAre) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  const ProcessResult writing = shop.run(check({"--write-baseline", "known.json", "a.nc"}));
  EXPECT_EQ(0, writing.exitCode);
  EXPECT_EQ("", writing.out);
  EXPECT_EQ("wrote 1 finding to known.json\n", writing.err);
  const ProcessResult known = shop.run(check({"--baseline", "known.json", "a.nc"}));
  EXPECT_EQ(0, known.exitCode);
  EXPECT_EQ("", known.out);
  // A program that grows and is renumbered keeps what is known of it.
  std::string grown = programWithoutFeed();
  grown.replace(grown.find("G01"), 3, "(ROUGH)\nN70 G01");
  shop.file("a.nc", grown);
  EXPECT_EQ(0, shop.run(check({"--baseline", "known.json", "a.nc"})).exitCode);
}

TEST(CheckBaseline, TheSameBlockOnceMoreIsANewFinding) {
  Shop shop;
  const std::vector<std::string> arguments = {
      "check",     "--dialect", "haas-lathe", "--select", "style-malformed-suppression",
      "--fail-on", "style"};
  const std::string comment = "M08 (ncvet: allow nothing-known)\n";
  shop.file("a.nc", "O0001\n" + comment + "M30\n");
  EXPECT_EQ(0, shop.run(with(arguments, {"--write-baseline", "known.json", "a.nc"})).exitCode);
  EXPECT_EQ(0, shop.run(with(arguments, {"--baseline", "known.json", "a.nc"})).exitCode);
  shop.file("a.nc", "O0001\n" + comment + "M09\n" + comment + "M30\n");
  const ProcessResult more = shop.run(with(arguments, {"--baseline", "known.json", "a.nc"}));
  EXPECT_EQ(1, more.exitCode);
  EXPECT_THAT(more.out, StartsWith("a.nc:4:"));
}

TEST(CheckBaseline, WritingTwiceGivesTheSameBytes) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed()).file("b.nc", programWithoutFeed());
  shop.run(check({"--write-baseline", "1.json"}));
  shop.run(check({"--write-baseline", "2.json", "--jobs", "1"}));
  EXPECT_EQ(shop.text("1.json"), shop.text("2.json"));
  EXPECT_THAT(shop.text("1.json"), HasSubstr("feed-missing"));
}

TEST(CheckBaseline, SarifTellsWhatIsUnchangedNewAndAbsent) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  shop.run(check({"--write-baseline", "known.json", "a.nc"}));
  EXPECT_THAT(shop.run(check({"--baseline", "known.json", "--format", "sarif", "a.nc"})).out,
              HasSubstr("\"unchanged\""));
  shop.file("a.nc", goodProgram());
  EXPECT_THAT(shop.run(check({"--baseline", "known.json", "--format", "sarif", "a.nc"})).out,
              HasSubstr("\"absent\""));
}

TEST(CheckBaseline, MalformedFileNamesTheLine) {
  Shop shop;
  shop.file("a.nc", goodProgram());
  shop.file("known.json", "{\"version\": 1,\n\"findings\": [\n{\"fingerprint\": \"xyz\"}]}");
  const ProcessResult result = shop.run(check({"--baseline", "known.json", "a.nc"}));
  EXPECT_EQ(2, result.exitCode);
  EXPECT_THAT(result.err, HasSubstr("known.json:3:"));
}

/// A program in lower case: capitals are a safe fix.
std::string lowerCase() { return "O0001\r\ng00 x10. z5.\r\nM30\r\n"; }

const std::vector<std::string> capitals = {"check", "--dialect", "haas-lathe", "--select",
                                           "style-lower-case"};

TEST(CheckFix, WritesTheFixedFileOnceAndKeepsLineEnds) {
  Shop shop;
  shop.file("a.nc", lowerCase());
  const ProcessResult result = shop.run(with(capitals, {"--fix", "--fail-on", "style", "a.nc"}));
  EXPECT_EQ(0, result.exitCode) << result.out;
  EXPECT_EQ("", result.out);
  EXPECT_EQ("O0001\r\nG00 X10. Z5.\r\nM30\r\n", shop.text("a.nc"));
  shop.run(with(capitals, {"--fix", "a.nc"}));
  EXPECT_EQ("O0001\r\nG00 X10. Z5.\r\nM30\r\n", shop.text("a.nc"));
}

TEST(CheckFix, DiffShowsWhatWouldChangeAndChangesNothing) {
  Shop shop;
  shop.file("a.nc", lowerCase());
  const ProcessResult result = shop.run(with(capitals, {"--diff", "--fail-on", "style", "a.nc"}));
  EXPECT_EQ(1, result.exitCode);
  EXPECT_EQ("--- a.nc\n+++ a.nc\n@@ -1,3 +1,3 @@\n O0001\r\n-g00 x10. z5.\r\n+G00 X10. Z5.\r\n"
            " M30\r\n",
            result.out);
  EXPECT_EQ(lowerCase(), shop.text("a.nc"));
}

TEST(CheckFix, OfStandardInputTheFixedProgramIsTheOutput) {
  Shop shop;
  EXPECT_EQ("O0001\r\nG00 X10. Z5.\r\nM30\r\n",
            shop.run(with(capitals, {"--fix", "-"}), lowerCase()).out);
}

TEST(CheckFix, SuppressedFindingsAreLeftAlone) {
  Shop shop;
  const std::string text = "O0001\ng00 x10. (ncvet: allow style-lower-case)\nM30\n";
  shop.file("a.nc", text);
  shop.run(with(capitals, {"--fix", "a.nc"}));
  EXPECT_EQ(text, shop.text("a.nc"));
}

TEST(CheckFix, FileThatCannotBeReplacedIsAFailure) {
  if (geteuid() == 0)
    GTEST_SKIP() << "root may write everywhere";
  Shop shop;
  shop.file("a.nc", lowerCase());
  std::filesystem::permissions(shop.path() / "a.nc", std::filesystem::perms(0444));
  const ProcessResult result = shop.run(with(capitals, {"--fix", "a.nc"}));
  EXPECT_EQ(2, result.exitCode);
  EXPECT_THAT(result.err, HasSubstr("cannot write a.nc"));
}

} // namespace
} // namespace ncvet::test
