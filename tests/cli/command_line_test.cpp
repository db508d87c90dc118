// The command line itself: what is an option and what a file, and what is said of mistakes.
#include "tests/support/process.h"

#include <gmock/gmock.h>

namespace ncvet::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::vector<std::string> commands = {"check", "trace", "explain", "rules", "dialects", "lsp"};

TEST(CommandLine, AFileWhoseNameBeginsWithAnAtSignIsAFile) {
  Shop shop;
  // Taken as a list of arguments, this one would rewrite the other.
  shop.file("evil.nc", "--fix=all\n--report\njson:stolen.json\nb.nc\n");
  shop.file("@evil.nc", programWithoutFeed());
  shop.file("b.nc", "o0001\ng00 x10.\nm30\n");
  const ProcessResult result = shop.run({"check", "--dialect", "haas-lathe", "@evil.nc"});
  EXPECT_THAT(result.out, StartsWith("@evil.nc:4:"));
  EXPECT_FALSE(std::filesystem::exists(shop.path() / "stolen.json"));
  EXPECT_EQ("o0001\ng00 x10.\nm30\n", shop.text("b.nc"));
}

TEST(CommandLine, AfterTwoDashesEverythingIsAFile) {
  Shop shop;
  shop.file("--fix", programWithoutFeed()).file("[a,b]", programWithoutFeed());
  EXPECT_THAT(shop.run({"check", "--dialect", "haas-lathe", "--", "--fix"}).out,
              HasSubstr("--fix:4:"));
  EXPECT_THAT(shop.run({"check", "--dialect", "haas-lathe", "[a,b]"}).out, HasSubstr("[a,b]:4:"));
}

TEST(CommandLine, AFolderMayHaveTheNameOfACommand) {
  Shop shop;
  shop.file("rules/a.nc", programWithoutFeed());
  EXPECT_THAT(shop.run({"check", "--dialect", "haas-lathe", "rules"}).out,
              HasSubstr("rules/a.nc:4:"));
}

TEST(CommandLine, MistakesAreSaidInOneLineThatNamesTheCure) {
  const struct {
    std::vector<std::string> arguments;
    const char *said;
  } cases[] = {
      {{"check", "--jobs", "x", "a.nc"}, "--jobs wants a number from 1, not \"x\""},
      {{"check", "--jobs", "0", "a.nc"}, "--jobs wants a number from 1, not \"0\""},
      {{"check", "a.nc", "--jobs"}, "--jobs wants a number from 1"},
      {{"check", "a.nc", "-j"}, "--jobs wants a number from 1"},
      {{"check", "--dialect=", "a.nc"}, "--dialect wants the id of a control"},
      {{"check", "--quite", "a.nc"}, "unknown option \"--quite\"; did you mean \"--quiet\"?"},
      {{"check", "--zzz", "a.nc"}, "unknown option \"--zzz\"; see `ncvet check --help`"},
      {{"check", "--diff=yes", "a.nc"}, "--diff takes no value"},
      {{"check", "--fix=some", "a.nc"}, "--fix wants one of safe, all, not \"some\""},
      {{"check", "--unsafe-fixes", "a.nc"}, "--unsafe-fixes needs --fix or --diff"},
      {{"check", "--fix", "--diff", "a.nc"}, "--fix and --diff exclude each other"},
      {{"check", "--stdin-filename", "b.nc", "a.nc"}, "--stdin-filename needs - among the paths"},
      {{"check", "--report", "jsn:a", "a.nc"}, "did you mean \"json\"?"},
      {{"check", "--report", "json:-", "--report", "gcc:-"}, "two reports to standard output"},
      {{"check", "--format", "json", "--report", "gcc:-"}, "standard output has a report already"},
      {{"explain"}, "ncvet explain wants a RULE; see `ncvet explain --help`"},
      {{"explain", "feed-missing", "again"}, "\"again\" is too much: ncvet explain takes one RULE"},
      {{"explain", "feed-missing", "--dialect", "haas-lath"}, "did you mean \"haas-lathe\"?"},
      {{"rules", "--format", "xml"}, "--format wants one of text, json"},
      {{"rules", "a.nc"}, "takes options only"},
      {{"--jobs", "2", "check"}, "a command comes first"},
      {{"a.nc"}, "to check it: ncvet check a.nc"},
      {{"help", "chck"}, "did you mean \"check\""},
  };
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  for (const auto &c : cases) {
    const ProcessResult result = shop.run(c.arguments);
    SCOPED_TRACE(::testing::PrintToString(c.arguments));
    EXPECT_EQ(2, result.exitCode);
    EXPECT_THAT(result.err, StartsWith("ncvet: error: "));
    EXPECT_THAT(result.err, HasSubstr(c.said));
    EXPECT_EQ(1, std::count(result.err.begin(), result.err.end(), '\n')) << result.err;
    EXPECT_EQ("", result.out);
  }
}

TEST(CommandLine, ListsMayHaveBlanks) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  EXPECT_EQ(1, shop.run({"check", "--dialect", "haas-lathe", "--select", "feed-missing, cycle",
                         "--ignore", "style ,", "a.nc"})
                   .exitCode);
}

TEST(CommandLine, OptionsAreTakenFromTheEnvironmentWhereTheyAreNotGiven) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  shop.environment("NCVET_DIALECT=haas-lathe").environment("NCVET_FORMAT=gcc");
  EXPECT_THAT(shop.run({"check", "a.nc"}).out, StartsWith("a.nc:4:1: error: "));
  EXPECT_THAT(shop.run({"check", "--format", "json", "a.nc"}).out, StartsWith("{"));
  shop.environment("NCVET_JOBS=many");
  const ProcessResult wrong = shop.run({"check", "a.nc"});
  EXPECT_EQ(2, wrong.exitCode);
  EXPECT_THAT(wrong.err, HasSubstr("NCVET_JOBS wants a number from 1, not \"many\""));
}

TEST(CommandLine, HelpNamesEveryOptionOfACommand) {
  Shop shop;
  for (const std::string &command : commands) {
    const ProcessResult help = shop.run({command, "--help"});
    EXPECT_EQ(0, help.exitCode);
    EXPECT_THAT(help.out, StartsWith("ncvet " + command + ": "));
    EXPECT_EQ(help.out, shop.run({"help", command}).out);
    EXPECT_THAT(shop.run({"--help"}).out, HasSubstr("ncvet " + command));
  }
}

/// Whoever redirects into a full disk must not believe that all is well.
TEST(FullDevice, IsAFailureOfEveryCommandSaidInOneLine) {
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "no /dev/full";
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  const std::vector<std::vector<std::string>> cases = {
      {"check", "a.nc"},
      {"check", "--format", "json", "a.nc"},
      {"check", "--report", "sarif:/dev/full", "-o", "out.txt", "a.nc"},
      {"check", "--write-baseline", "-", "a.nc"},
      {"check", "--write-baseline", "/dev/full", "a.nc"},
      {"trace", "a.nc"},
      {"explain", "feed-missing"},
      {"rules"},
      {"rules", "--format", "json"},
      {"dialects"},
      {"--help"},
      {"--version"},
      {"check", "--help"},
  };
  for (const auto &arguments : cases) {
    const ProcessResult result = shop.runInto("/dev/full", arguments);
    SCOPED_TRACE(::testing::PrintToString(arguments));
    EXPECT_EQ(2, result.exitCode);
    EXPECT_THAT(result.err, HasSubstr("ncvet: error: cannot write "));
    EXPECT_THAT(result.err, HasSubstr("No space left on device\n"));
  }
}

TEST(LastLine, CountsFindingsAndSaysHowToGetTheFixes) {
  Shop shop;
  shop.file("a.nc", "O0001\ng00 x10. z5.\nM30\n").file("b.nc", "O0002\nM30\n");
  const std::vector<std::string> lower = {"--dialect", "haas-lathe", "--select",
                                          "style-lower-case"};
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "check");
    arguments.insert(arguments.end(), lower.begin(), lower.end());
    return shop.run(arguments).err;
  };
  EXPECT_EQ(run({}), "1 finding in 1 of 2 files: 1 style\n"
                     "fixes: 1 safe (--diff shows, --fix writes)\n");
  EXPECT_EQ(run({"--format", "json"}), "");
  EXPECT_EQ(run({"--quiet"}), "");
  EXPECT_THAT(run({"--diff"}), StartsWith("would fix 1 finding in 1 file: style-lower-case 1\n"));
  EXPECT_EQ(run({"--fix"}), "fixed 1 finding in 1 file: style-lower-case 1\n"
                            "no findings in 2 files, 3 blocks\n");
}

TEST(LastLine, SaysThatADiffLeavesOutUnsafeFixes) {
  Shop shop;
  shop.file("a.nc", "O0001\nG96 S180 M03 M08\nM30\n");
  const ProcessResult diff = shop.run(
      {"check", "--dialect", "haas-lathe", "--select", "block-too-many-m-codes", "--diff", "a.nc"});
  EXPECT_EQ(diff.out, "");
  EXPECT_THAT(diff.err, HasSubstr("1 unsafe (--diff --unsafe-fixes shows, --fix=all writes)"));
}

TEST(ExplainCommand, SpeaksToItsReaderAndNotToTheMakersOfTheRule) {
  Shop shop;
  const std::string all = shop.run({"explain", "arc-radius-mismatch", "--all"}).out;
  EXPECT_THAT(all, Not(HasSubstr("expect: ")));
  EXPECT_THAT(all, Not(HasSubstr("Source:")));
  EXPECT_THAT(all, HasSubstr("```nc sinumerik\n"));
  // Without a control, the programs of one of them; the others are named.
  const std::string one = shop.run({"explain", "arc-radius-mismatch"}).out;
  EXPECT_THAT(one, HasSubstr("```nc haas-lathe\n"));
  EXPECT_THAT(one, Not(HasSubstr("```nc sinumerik")));
  EXPECT_THAT(one, HasSubstr("--dialect ID` shows those for "));
}

TEST(ExplainCommand, SaysThatARuleIsForOtherControls) {
  Shop shop;
  EXPECT_THAT(shop.run({"explain", "ecs-input-unchecked", "--dialect", "haas-lathe"}).out,
              HasSubstr("It is no rule for haas-lathe"));
  EXPECT_THAT(shop.run({"explain", "ecs-input-unchecked", "--dialect", "ecs"}).out,
              Not(HasSubstr("It is no rule for")));
}

TEST(TraceCommand, ReadsStandardInputUnderItsName) {
  Shop shop;
  const ProcessResult result = shop.run(
      {"trace", "--dialect", "haas-lathe", "--stdin-filename", "b.nc", "-"}, programWithoutFeed());
  EXPECT_THAT(result.out, HasSubstr("{\"path\":\"b.nc\",\"line\":4,\"kind\":\"linear\""));
  EXPECT_EQ(2, shop.run({"trace", "--stdin-filename", "b.nc", "a.nc"}).exitCode);
}

} // namespace
} // namespace ncvet::test
