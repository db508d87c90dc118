// The HTML report: that it needs nothing beside itself, holds what it should, and lets nothing out.
#include "formats/reports/page_json.h"
#include "formats/reports/page_parts.h"
#include "formats/reports/viewer_files.h"
#include "tests/support/sample_report.h"

#include "llvm/Support/Base64.h"
#include "llvm/Support/SHA256.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <regex>

using namespace ncvet;
using namespace ncvet::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

using Json = nlohmann::json;

/// What is between the first `begin` and the next `end`.
std::string between(llvm::StringRef text, llvm::StringRef begin, llvm::StringRef end) {
  const auto [before, rest] = text.split(begin);
  return rest.split(end).first.str();
}

/// The JSON of one of the page's elements; null when there is none.
Json jsonOf(const std::string &page, const std::string &id) {
  const std::string text =
      between(page, "<script type=\"application/json\" id=\"" + id + "\">", "</script>");
  return text.empty() ? Json() : Json::parse(text, nullptr, /*allow_exceptions=*/false);
}

std::string hashOf(const std::string &text) {
  const auto hash = llvm::SHA256::hash(
      llvm::makeArrayRef(reinterpret_cast<const uint8_t *>(text.data()), text.size()));
  return "'sha256-" + llvm::encodeBase64(hash) + "'";
}

size_t countOf(llvm::StringRef text, llvm::StringRef part) { return text.count(part); }

/// A report about one text with one finding on its first line.
struct OneText {
  SourceSet sources;
  Report report;
  const SourceFile &file;

  explicit OneText(llvm::StringRef text, llvm::StringRef name = "a.nc")
      : file(sources.add(name, text)) {
    report.toolVersion = "0.1.0";
    report.rules = SampleReport::rules();
    report.sources = &sources;
    report.files = {{name.str(), "haas-mill", 1, true, ""}};
    Finding finding;
    finding.range = {file.id(), 0, uint32_t(std::min<size_t>(1, text.size()))};
    finding.message = "`" + text.take_front(60).str() + "` is odd";
    report.findings = {finding};
  }
};

} // namespace

TEST(HtmlReport, ScriptAndStyleAreTheOnesThatThePolicyAllowsAndNothingElseIs) {
  const SampleReport sample;
  const std::string page = written("html", sample.report);
  const std::string policy = between(page, "Content-Security-Policy\" content=\"", "\"");
  EXPECT_THAT(policy, HasSubstr("default-src 'none'"));
  EXPECT_THAT(policy, Not(HasSubstr("unsafe")));
  EXPECT_THAT(policy, Not(HasSubstr("http")));
  EXPECT_THAT(policy, HasSubstr("script-src " + hashOf(between(page, "<script>", "</script>"))));
  EXPECT_THAT(policy, HasSubstr("style-src " + hashOf(between(page, "<style>", "</style>"))));
  EXPECT_EQ(countOf(page, "<script>"), 1u);
}

TEST(HtmlReport, NothingInThePageLeadsOutOfIt) {
  const SampleReport sample;
  const std::string page = written("html", sample.report);
  for (const char *word : {"http:", "https:", "src=", "@import", "url(", "fetch(", "XMLHttpRequest",
                           "innerHTML", "eval(", "document.write"})
    EXPECT_THAT(page, Not(HasSubstr(word)));
}

TEST(HtmlReport, WithoutDataItIsSmall) {
  size_t bytes = 0;
  for (const ViewerFile &file : viewerFiles()) {
    EXPECT_FALSE(file.text.empty()) << file.name.str();
    EXPECT_LE(file.text.count('\n'), 500u) << file.name.str();
    bytes += file.text.size();
  }
  EXPECT_LT(bytes, 400'000u);
}

TEST(HtmlReport, FindingsFilesAndRulesAreInIt) {
  const SampleReport sample;
  const std::string page = written("html", sample.report);
  const Json report = jsonOf(page, "report");
  ASSERT_TRUE(report.is_object()) << page.substr(0, 2000);
  EXPECT_EQ(report["version"], 1);
  EXPECT_EQ(report["tool"]["version"], "0.1.0");
  ASSERT_EQ(report["findings"].size(), 3u);
  EXPECT_EQ(report["findings"][0]["message"],
            "X30. Y0. drills again: G83 of line 3 is still active");
  EXPECT_EQ(report["findings"][0]["related"][0]["line"], 3);
  EXPECT_EQ(report["findings"][0]["fix"]["edits"][0]["text"], "G80\n");
  EXPECT_EQ(report["files"][1]["complete"], false);
  EXPECT_EQ(report["rules"]["missing-feed"], "A cutting motion has no feed.");
  EXPECT_EQ(report["notifications"][0]["path"], "gone.nc");
  EXPECT_THAT(report["texts"], ElementsAre("programs/bore \xC3\xB6.nc", "programs/sub.nc"));
}

TEST(HtmlReport, TextsAreUtf8WithOneKindOfLineEnd) {
  const SampleReport sample;
  const std::string page = written("html", sample.report);
  EXPECT_EQ(jsonOf(page, "text-1")["text"], "O0002 (B\xC3\xB6hrer)\nG1 X100\nM99\n");
  OneText mixed("\xEF\xBB\xBFG0 X1\r\nG0 X2\rG0 X3\n\nM30");
  EXPECT_EQ(jsonOf(written("html", mixed.report), "text-0")["text"],
            "G0 X1\nG0 X2\nG0 X3\n\nM30\n");
}

TEST(HtmlReport, SuppressedFindingsAreNotInIt) {
  SampleReport sample;
  sample.report.findings[0].suppressed = true;
  EXPECT_EQ(jsonOf(written("html", sample.report), "report")["findings"].size(), 2u);
}

TEST(HtmlReport, ATextCannotBecomeMarkup) {
  for (const char *text :
       {"</script><script>alert(1)</script>", "<img src=x onerror=alert(1)>", "<!--<script>",
        "]]><svg onload=alert(1)>", "{{script}}{{data}}", "\"}]}</SCRIPT >"}) {
    OneText one(text, text);
    const std::string page = written("html", one.report);
    OneText plain("G1");
    const std::string same = written("html", plain.report);
    EXPECT_EQ(countOf(page, "<"), countOf(same, "<")) << text;
    const Json report = jsonOf(page, "report");
    ASSERT_TRUE(report.is_object()) << text;
    EXPECT_EQ(report["texts"][0], text);
    EXPECT_EQ(jsonOf(page, "text-0")["text"], std::string(text) + "\n");
  }
}

TEST(HtmlReport, AnyBytesGiveAPage) {
  std::string all;
  for (int i = 0; i < 256; ++i)
    all += char(i);
  OneText one(all);
  const std::string page = written("html", one.report);
  EXPECT_TRUE(isValidUtf8(page));
  EXPECT_TRUE(jsonOf(page, "text-0").is_object());
  OneText empty("");
  EXPECT_EQ(jsonOf(written("html", empty.report), "text-0")["text"], "");
}

TEST(HtmlReport, LongLinesAreCut) {
  OneText one("G1 X1\n(" + std::string(1'000'000, 'x') + ")\nM30\n");
  const std::string text = jsonOf(written("html", one.report), "text-0")["text"];
  EXPECT_LT(text.size(), 10'000u);
  EXPECT_TRUE(llvm::StringRef(text).endswith("\xE2\x80\xA6\nM30\n"));
}

TEST(HtmlReport, ATextThatIsTooLongIsCutAndSaysSo) {
  SourceSet sources;
  const SourceFile &file = sources.add("a.nc", "G0 X1\nG0 X2\nG0 X3\n");
  std::string out;
  llvm::raw_string_ostream stream(out);
  size_t budget = 13;
  writeTextJson(file, {}, budget, stream);
  const Json json = Json::parse(stream.str(), nullptr, false);
  EXPECT_EQ(json["text"], "G0 X1\nG0 X2\n");
  EXPECT_EQ(json["cut"], true);
}

TEST(HtmlReport, ColoursAreInUnitsOfTheShownText) {
  SourceSet sources;
  // A letter of Windows-1252, and one that takes two units of UTF-16.
  const SourceFile &latin = sources.add("a.nc", "(\xF6) G1\r\nM30\n");
  const SourceFile &wide = sources.add("b.nc", "(\xF0\x9D\x84\x9E) G1\n");
  const auto coloursOf = [](const SourceFile &file, std::vector<TextColour> colours) {
    std::string out;
    llvm::raw_string_ostream stream(out);
    size_t budget = 1000;
    writeTextJson(file, colours, budget, stream);
    return Json::parse(stream.str(), nullptr, false)["colours"].get<std::string>();
  };
  const auto bytesOf = [](std::vector<uint8_t> bytes) { return llvm::encodeBase64(bytes); };
  // Comment 0 to 3, G1 at 4, and after the end of the line M30 at 7.
  EXPECT_EQ(coloursOf(latin, {{0, 3, 14}, {4, 6, 0}, {8, 11, 1}}),
            bytesOf({0, 3, 14, 1, 2, 0, 1, 3, 1}));
  EXPECT_EQ(coloursOf(wide, {{0, 6, 14}, {7, 9, 0}}), bytesOf({0, 4, 14, 1, 2, 0}));
}

TEST(HtmlReport, ThePathOfTheToolIsInItAsTheDocumentSays) {
  OneText one("G0 X1\n");
  ToolPath path;
  path.files = {one.file.id()};
  path.programmed.moves = {{PathMotion::Rapid, false, 0, 1, {1, 2, pathUnknown}},
                           {PathMotion::Arc, true, 0, 1, {3, 4, 5}}};
  path.programmed.arcs = {{1, 2, 0, {7, 8}, -0.25f}};
  path.settings = {{}};
  path.settings[0].tool = 4;
  path.settings[0].cycle = "</script>";
  path.operations = {{"FACE", "", 4, 0, 1}};
  path.sections = {{0, 0, 0}};
  path.end = {PathEnd::Unknown, 0, 1, "what decides here is not known"};
  path.machine.stock = PathBox{{0.0, std::nullopt, -1.0}, {}};
  one.report.views.push_back({one.file.id(), {}, path});
  const Json json = jsonOf(written("html", one.report), "path-0");
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["files"][0], "a.nc");
  EXPECT_EQ(json["programmed"]["count"], 2);
  EXPECT_EQ(json["programmed"]["kind"], "AII="); // 0, and 2 with 128
  EXPECT_EQ(json["programmed"]["x"], "AACAPwAAQEA=");
  EXPECT_EQ(json["programmed"]["arcs"]["axes"], "Ag==");
  EXPECT_TRUE(json["centre"].is_null());
  EXPECT_EQ(json["settings"][0]["tool"], 4);
  EXPECT_EQ(json["settings"][0]["cycle"], "</script>");
  EXPECT_EQ(json["end"]["kind"], "unknown");
  EXPECT_EQ(json["machine"]["stock"]["min"], Json::parse("[0.0,null,-1.0]"));
  EXPECT_TRUE(json["machine"]["rapid"].is_null());
}

TEST(HtmlReport, NumbersInShortFormTakeSevenBitsAByte) {
  NumberBytes bytes;
  bytes.addShort(5);
  bytes.addShort(300);
  EXPECT_EQ(bytes.base64(), llvm::encodeBase64(llvm::StringRef("\x05\xAC\x02")));
}
