// Tests of formats/reports: the order of output, and the bytes of each format.
#include "tests/support/sample_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <random>

using namespace ncvet;
using namespace ncvet::test;
using testing::HasSubstr;
using testing::Not;

namespace {

using Json = nlohmann::json;

/// What the text writer says of one finding about `range` in `text`, without the first line.
std::string excerpt(llvm::StringRef text, uint32_t begin, uint32_t end) {
  SampleReport sample;
  const SourceFile &file = sample.sources.add("a.nc", text);
  Finding finding;
  finding.range = {file.id(), begin, end};
  sample.report.findings = {finding};
  const std::string all = written("text", sample.report);
  return all.substr(all.find('\n') + 1);
}

std::string excerptOf(llvm::StringRef text, llvm::StringRef part) {
  const auto begin = static_cast<uint32_t>(text.find(part));
  return excerpt(text, begin, begin + static_cast<uint32_t>(part.size()));
}

Json parsed(const std::string &text) {
  Json value = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  EXPECT_FALSE(value.is_discarded()) << text;
  return value;
}

} // namespace

TEST(ReportTest, EveryListedFormatHasAWriterAndNoOtherHas) {
  const SampleReport sample;
  for (const ReportFormat &format : reportFormats()) {
    EXPECT_FALSE(format.summary.empty());
    EXPECT_THAT(written(format.name, sample.report), HasSubstr("X30. Y0. drills again"));
  }
  EXPECT_EQ(makeReportWriter("xml"), nullptr);
  EXPECT_EQ(makeReportWriter(""), nullptr);
  EXPECT_EQ(reportFormats().front().name, "text");
}

TEST(ReportTest, FindingsAreSortedByPathLineColumnAndRule) {
  SampleReport sample;
  Finding late = sample.report.findings[0];
  std::vector<Finding> expected = sample.report.findings;
  Finding twin = expected[1]; // the same place, another rule
  twin.rule = 2;
  sample.report.findings = {expected[2], twin, expected[1], expected[0]};
  sortReport(sample.report);
  std::vector<std::string> order;
  for (const Finding &finding : sample.report.findings)
    order.push_back(sample.sources.get(finding.range.file).display() + ":" +
                    std::to_string(finding.range.begin) + ":" +
                    sample.report.rules[finding.rule].id.str());
  EXPECT_THAT(order, testing::ElementsAre("programs/bore \xC3\xB6.nc:36:cycle-unintended-execution",
                                          "programs/sub.nc:15:decimal-point",
                                          "programs/sub.nc:15:missing-feed",
                                          "programs/sub.nc:18:decimal-point"));
}

TEST(ReportTest, FindingsThatAreSuppressedOrKnownAppearInSarifOnly) {
  SampleReport sample;
  sample.report.findings[0].suppressed = true;
  sample.report.findings[2].baselined = true;
  for (const ReportFormat &known : reportFormats()) {
    const llvm::StringRef format = known.name;
    if (format == "sarif")
      continue;
    const std::string out = written(format, sample.report);
    EXPECT_THAT(out, Not(HasSubstr("drills again"))) << format.str();
    EXPECT_THAT(out, Not(HasSubstr("decimal point"))) << format.str();
    EXPECT_THAT(out, HasSubstr("G1 without a feed")) << format.str();
  }
  const std::string sarif = written("sarif", sample.report);
  EXPECT_THAT(sarif, HasSubstr("drills again"));
  EXPECT_THAT(sarif, HasSubstr("no decimal point"));
}

TEST(ReportTest, ARunWithoutFindingsIsAWellFormedReport) {
  SourceSet sources;
  Report report;
  report.toolVersion = "0.1.0";
  report.sources = &sources;
  EXPECT_EQ(written("text", report), "");
  EXPECT_EQ(written("gcc", report), "");
  EXPECT_EQ(written("json", report),
            "{\"version\":1,\"tool\":{\"name\":\"ncvet\",\"version\":\"0.1.0\"},\n"
            "\"files\":[\n],\n\"findings\":[\n],\n\"absent\":[\n],\n\"problems\":[\n],\n"
            "\"summary\":{\"files\":0,\"findings\":0,\"errors\":0,\"warnings\":0,\"style\":0,"
            "\"suppressed\":0,\"known\":0,\"absent\":0,\"fixes\":{\"safe\":0,\"unsafe\":0}}}\n");
  EXPECT_EQ(parsed(written("sarif", report))["runs"][0]["results"], Json::array());
  EXPECT_EQ(written("checkstyle", report), "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                                           "<checkstyle version=\"4.3\">\n</checkstyle>\n");
}

TEST(TextReportTest, HasTheLayoutOfClang) {
  EXPECT_EQ(written("text", SampleReport().report),
            "programs/bore \xC3\xB6.nc:5:1: warning: X30. Y0. drills again: G83 of line 3 is still "
            "active [cycle-unintended-execution]\n"
            "   5 | X30. Y0. (TO CLAMP)\n"
            "     | ^~~~~~~~\n"
            "programs/bore \xC3\xB6.nc:3:1: note: G83 becomes active here\n"
            "programs/bore \xC3\xB6.nc:5:1: fix: insert G80 before this block\n"
            "programs/sub.nc:2:1: error: G1 without a feed [missing-feed, possible]\n"
            "   2 | G1 X100\n"
            "     | ^~~~~~~\n"
            "programs/bore \xC3\xB6.nc:6:1: note: O0002 is called here\n"
            "programs/sub.nc:2:4: style: X100 has no decimal point [decimal-point]\n"
            "   2 | G1 X100\n"
            "     |    ^~~~\n"
            "programs/sub.nc:2:8: fix: write X100.\n");
}

TEST(TextReportTest, CaretsAreUnderTheRangeAfterUmlautsAndTabs) {
  EXPECT_EQ(excerptOf("(\xC3\xB6\xC3\xB6) X1 Y2\n", "X1"), "   1 | (\xC3\xB6\xC3\xB6) X1 Y2\n"
                                                           "     |      ^~\n");
  EXPECT_EQ(excerptOf("(\xF6\xF6) X1 Y2\n", "X1"), "   1 | (\xC3\xB6\xC3\xB6) X1 Y2\n"
                                                   "     |      ^~\n");
  EXPECT_EQ(excerptOf("G0\tX1\n", "X1"), "   1 | G0      X1\n"
                                         "     |         ^~\n");
  EXPECT_EQ(excerptOf("G0\tX1\n", "G0\tX1"), "   1 | G0      X1\n"
                                             "     | ^~~~~~~~~~\n");
}

TEST(TextReportTest, CaretsCountTheCellsOfWideAndCombiningCharacters) {
  EXPECT_EQ(excerptOf("(\xE9\x92\xBB) X1\n", "X1"), "   1 | (\xE9\x92\xBB) X1\n"
                                                    "     |      ^~\n");
  EXPECT_EQ(excerptOf("(o\xCC\x88) X1\n", "X1"), "   1 | (o\xCC\x88) X1\n"
                                                 "     |     ^~\n");
}

TEST(TextReportTest, ARangeIsCutAtTheEndOfItsFirstLine) {
  EXPECT_EQ(excerpt("G0 X1\nG1 Y2\n", 3, 11), "   1 | G0 X1\n"
                                              "     |    ^~\n");
  EXPECT_EQ(excerpt("G0 X1\r\nG1 Y2\n", 3, 11), "   1 | G0 X1\n"
                                                "     |    ^~\n");
  EXPECT_EQ(excerpt("G0 X1\rG1 Y2\r", 6, 8), "   2 | G1 Y2\n"
                                             "     | ^~\n");
}

TEST(TextReportTest, AnEmptyRangeHasOneCaret) {
  EXPECT_EQ(excerpt("G0 X1\n", 3, 3), "   1 | G0 X1\n     |    ^\n");
  EXPECT_EQ(excerpt("G0 X1\n", 5, 5), "   1 | G0 X1\n     |      ^\n");
  EXPECT_EQ(excerpt("G0 X1\r\n", 6, 6), "   1 | G0 X1\n     |      ^\n");
  EXPECT_EQ(excerpt("G0 X1\n", 6, 6), "   2 |\n     | ^\n");
  EXPECT_EQ(excerpt("", 0, 0), "   1 |\n     | ^\n");
  EXPECT_EQ(excerpt("G0", 90, 99), "   1 | G0\n     |   ^\n");
}

TEST(TextReportTest, TheByteOrderMarkIsNotShown) {
  EXPECT_EQ(excerptOf("\xEF\xBB\xBFG0 X1\n", "X1"), "   1 | G0 X1\n     |    ^~\n");
  EXPECT_EQ(excerpt("\xEF\xBB\xBFG0 X1\n", 0, 5), "   1 | G0 X1\n     | ^~\n");
}

TEST(TextReportTest, ControlCharactersDoNotReachTheTerminal) {
  const std::string shown = excerptOf(llvm::StringRef("\x1B[2J\0X1\xE2\x80\xAE\x7F\n", 12), "X1");
  EXPECT_EQ(shown, "   1 | \xE2\x90\x9B[2J\xE2\x90\x80X1\xEF\xBF\xBD\xE2\x90\xA1\n"
                   "     |      ^~\n");
  SampleReport sample;
  sample.report.findings[0].message = "a\nb\x1B[0m";
  EXPECT_THAT(written("text", sample.report), HasSubstr("a\xE2\x90\x8A"
                                                        "b\xE2\x90\x9B[0m ["));
}

TEST(TextReportTest, OfALineAsLongAsTheFileOnlyThePartAtTheRangeIsShown) {
  std::string text;
  for (int i = 0; i < 100000; ++i)
    text += "X1.\xC3\xB6";
  const std::string shown = excerpt(text, 250000, 250003);
  EXPECT_LT(shown.size(), 1500u);
  EXPECT_THAT(shown, HasSubstr("   1 | ..."));
  EXPECT_THAT(shown, HasSubstr("...\n"));
  EXPECT_TRUE(isValidUtf8(shown));
  const size_t lineEnd = shown.find('\n');
  const size_t caret = shown.find('^') - lineEnd - 1;
  // The caret's cell counts code points, and what is there is the range's text.
  const std::string line = shown.substr(0, lineEnd);
  size_t byte = 0;
  for (size_t cell = 0; cell < caret; ++cell)
    byte += codePointLength(llvm::StringRef(line).substr(byte), Encoding::Utf8);
  EXPECT_EQ(line.substr(byte, 3), "X1.");
}

TEST(TextReportTest, ColoursAreOffUnlessAskedFor) {
  const SampleReport sample;
  EXPECT_THAT(written("text", sample.report), Not(HasSubstr("\x1B")));
  const std::string colored = written("text", sample.report, {/*color=*/true});
  EXPECT_THAT(colored, HasSubstr("\x1B[0;1;35mwarning: "));
  EXPECT_THAT(colored, HasSubstr("\x1B[0;1;31merror: "));
  EXPECT_THAT(colored, HasSubstr("\x1B[0;1;32m^~~~"));
  // Without the codes it is the same text.
  std::string plain;
  for (size_t at = 0; at < colored.size(); ++at) {
    if (colored[at] == '\x1B')
      at = colored.find('m', at);
    else
      plain.push_back(colored[at]);
  }
  EXPECT_EQ(plain, written("text", sample.report));
}

TEST(JsonReportTest, IsVersionOneWithItsKeysInOrder) {
  EXPECT_EQ(
      written("json", SampleReport().report),
      "{\"version\":1,\"tool\":{\"name\":\"ncvet\",\"version\":\"0.1.0\"},\n\"files\":[\n"
      "{\"path\":\"programs/bore \xC3\xB6.nc\",\"dialect\":\"haas-mill\",\"blocks\":7,"
      "\"complete\":true,\"guess\":null},\n"
      "{\"path\":\"programs/sub.nc\",\"dialect\":\"haas-mill\",\"blocks\":3,\"complete\":false,"
      "\"guess\":null}\n"
      "],\n\"findings\":[\n"
      "{\"rule\":\"cycle-unintended-execution\",\"severity\":\"warning\",\"certainty\":"
      "\"definite\",\"message\":\"X30. Y0. drills again: G83 of line 3 is still active\","
      "\"path\":\"programs/bore \xC3\xB6.nc\",\"line\":5,\"column\":1,\"endLine\":5,"
      "\"endColumn\":9,\"related\":[{\"path\":\"programs/bore \xC3\xB6.nc\",\"line\":3,"
      "\"column\":1,\"message\":\"G83 becomes active here\"}],\"trace\":[],\"fix\":{"
      "\"description\":\"insert G80 before this block\",\"safety\":\"safe\",\"edits\":[{\"path\":"
      "\"programs/bore \xC3\xB6.nc\",\"line\":5,\"column\":1,\"endLine\":5,\"endColumn\":1,"
      "\"text\":\"G80\\n\"}]},\"fingerprint\":\"0123456789abcdef\"},\n"
      "{\"rule\":\"missing-feed\",\"severity\":\"error\",\"certainty\":\"possible\",\"message\":"
      "\"G1 without a feed\",\"path\":\"programs/sub.nc\",\"line\":2,\"column\":1,\"endLine\":2,"
      "\"endColumn\":8,\"related\":[],\"trace\":[{\"path\":\"programs/bore \xC3\xB6.nc\","
      "\"line\":6,\"message\":\"O0002 is called here\"}],\"fix\":null,\"fingerprint\":"
      "\"0000000000000002\"},\n"
      "{\"rule\":\"decimal-point\",\"severity\":\"style\",\"certainty\":\"definite\",\"message\":"
      "\"X100 has no decimal point\",\"path\":\"programs/sub.nc\",\"line\":2,\"column\":4,"
      "\"endLine\":2,\"endColumn\":8,\"related\":[],\"trace\":[],\"fix\":{\"description\":"
      "\"write X100.\",\"safety\":\"unsafe\",\"edits\":[{\"path\":\"programs/sub.nc\",\"line\":2,"
      "\"column\":8,\"endLine\":2,\"endColumn\":8,\"text\":\".\"}]},\"fingerprint\":"
      "\"0000000000000003\"}\n],\n\"absent\":[\n],\n\"problems\":[\n"
      "{\"severity\":\"error\",\"path\":\"gone.nc\",\"message\":\"cannot read gone.nc: No such "
      "file or directory\"}\n],\n\"summary\":{\"files\":2,\"findings\":3,\"errors\":1,"
      "\"warnings\":1,\"style\":1,\"suppressed\":0,\"known\":0,\"absent\":0,\"fixes\":{"
      "\"safe\":1,\"unsafe\":1}}}\n");
}

TEST(JsonReportTest, QuotedBytesOfAnEightBitProgramBecomeLetters) {
  SampleReport sample;
  const SourceFile &file = sample.sources.add("a.nc", "(B\xF6hrer) X1\n");
  Finding finding;
  finding.range = rangeOf(file, "X1");
  finding.message = "the comment B\xF6hrer is long";
  sample.report.findings = {finding};
  sample.report.files = {{"gone\xFF.nc", "haas-mill", 1, true, ""}}; // a name in no encoding
  const Json json = parsed(written("json", sample.report));
  EXPECT_EQ(json["findings"][0]["message"], "the comment B\xC3\xB6hrer is long");
  EXPECT_EQ(json["findings"][0]["column"], 10);
  EXPECT_EQ(json["files"][0]["path"], "gone\xEF\xBF\xBD.nc");
}

TEST(JsonReportTest, ARangeOverLinesEndsWhereItEnds) {
  SampleReport sample;
  const SourceFile &file = sample.sources.add("a.nc", "G0 X1\r\nG1 Y2\r\n");
  Finding finding;
  finding.range = {file.id(), 3, 10};
  sample.report.findings = {finding};
  const Json json = parsed(written("json", sample.report))["findings"][0];
  EXPECT_EQ(json["line"], 1);
  EXPECT_EQ(json["column"], 4);
  EXPECT_EQ(json["endLine"], 2);
  EXPECT_EQ(json["endColumn"], 4);
}

TEST(GccReportTest, HasOneLineAFinding) {
  EXPECT_EQ(written("gcc", SampleReport().report),
            "programs/bore \xC3\xB6.nc:5:1: warning: X30. Y0. drills again: G83 of line 3 is still "
            "active [cycle-unintended-execution]\n"
            "programs/sub.nc:2:1: error: G1 without a feed [missing-feed]\n"
            "programs/sub.nc:2:4: note: X100 has no decimal point [decimal-point]\n");
}

TEST(CheckstyleReportTest, GroupsFindingsByFileAndEscapesText) {
  SampleReport sample;
  sample.report.findings[0].message = "a < b & \"c\"\x01";
  EXPECT_EQ(written("checkstyle", sample.report),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<checkstyle version=\"4.3\">\n"
            "  <file name=\"programs/bore \xC3\xB6.nc\">\n"
            "    <error line=\"5\" column=\"1\" severity=\"warning\" "
            "message=\"a &lt; b &amp; &quot;c&quot;\xE2\x90\x81\" "
            "source=\"ncvet.cycle-unintended-execution\"/>\n"
            "  </file>\n"
            "  <file name=\"programs/sub.nc\">\n"
            "    <error line=\"2\" column=\"1\" severity=\"error\" message=\"G1 without a feed\" "
            "source=\"ncvet.missing-feed\"/>\n"
            "    <error line=\"2\" column=\"4\" severity=\"info\" "
            "message=\"X100 has no decimal point\" source=\"ncvet.decimal-point\"/>\n"
            "  </file>\n"
            "</checkstyle>\n");
}

TEST(ReportTest, AnyBytesAndRangesGiveValidReports) {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    SampleReport sample;
    // Mostly what breaks lines, columns and encodings.
    const llvm::StringRef pieces[] = {
        "\n",   "\r",   "\r\n",        "\t",   "X1", llvm::StringRef("\0", 1),
        "\xF6", "\xC3", "\xB6",        "\x1B", "\"", "\xEF\xBB\xBF",
        "<",    "&",    "\xE9\x92\xBB"};
    std::string text;
    for (size_t i = random() % 60; i > 0; --i)
      text += pieces[random() % std::size(pieces)];
    const SourceFile &file = sample.sources.add(text, text); // its name is as bad
    const auto anyRange = [&] {
      return SourceRange{file.id(), static_cast<uint32_t>(random() % 70),
                         static_cast<uint32_t>(random() % 70)};
    };
    Finding finding;
    finding.range = anyRange();
    finding.message = text;
    finding.notes.push_back({anyRange(), text});
    finding.path.push_back({anyRange(), text});
    finding.fix = Fix{text, FixSafety::Unsafe, {}};
    finding.fix->edits.push_back({anyRange(), text});
    sample.report.findings.push_back(finding);
    sortReport(sample.report);
    const LineColumn begin = file.position(finding.range.begin);
    const Json json = parsed(written("json", sample.report));
    EXPECT_EQ(json["findings"].size(), 4u);
    for (const Json &one : json["findings"]) {
      EXPECT_LE(std::pair(one["line"].get<uint32_t>(), one["column"].get<uint32_t>()),
                std::pair(one["endLine"].get<uint32_t>(), one["endColumn"].get<uint32_t>()));
    }
    EXPECT_TRUE(std::any_of(json["findings"].begin(), json["findings"].end(), [&](const Json &one) {
      return one["line"] == begin.line && one["column"] == begin.column;
    }));
    EXPECT_EQ(parsed(written("sarif", sample.report))["runs"][0]["results"].size(), 4u);
    EXPECT_TRUE(isValidUtf8(written("checkstyle", sample.report)));
    const std::string shown = written("text", sample.report);
    for (const char byte : shown)
      EXPECT_TRUE(byte == '\n' || static_cast<unsigned char>(byte) >= 0x20);
  }
}
