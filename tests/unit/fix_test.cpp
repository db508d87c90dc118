// Fixes: applying all safe ones gives no new finding, and a second time changes nothing.
#include "analyzer/check/fix.h"
#include "tests/support/rule_pages.h"

#include "llvm/Support/FileSystem.h"
#include <gtest/gtest.h>

namespace ncvet::test {
namespace {

Session sessionFor(const PageProgram &program) {
  SessionOptions options;
  options.dialect = program.dialect;
  options.profile = "all";
  if (!program.machine.empty())
    options.machine = MachineSource{"machine.json", program.machine};
  return Session(std::move(options));
}

struct Found {
  std::map<RuleId, unsigned> counts; ///< of findings
  bool fixable = false;              ///< one of them has a fix
};

Found check(Session &session, const std::string &text) {
  SourceSet sources;
  const FileOutcome outcome = checkFile(session, sources, sources.add("a.nc", text));
  EXPECT_EQ("", outcome.error);
  Found found;
  for (const CheckedFinding &checked : outcome.findings) {
    ++found.counts[checked.finding.rule];
    found.fixable |= checked.finding.fix.has_value();
  }
  return found;
}

std::string fixed(Session &session, const std::string &text, bool unsafe) {
  SourceSet sources;
  return fixText(session, sources.add("a.nc", text), unsafe).text;
}

class FixLaws : public ::testing::TestWithParam<PageProgram> {};

TEST_P(FixLaws, NoNewFindingAndNothingLeftForASecondTime) {
  const PageProgram &program = GetParam();
  Session session = sessionFor(program);
  const std::string &text = program.files[0].text;
  const Found before = check(session, text);
  if (!before.fixable)
    return; // most programs, and some loop until the analysis gives up
  for (const bool unsafe : {false, true}) {
    const std::string once = fixed(session, text, unsafe);
    if (once == text)
      continue;
    for (const auto &[rule, count] : check(session, once).counts) {
      const auto old = before.counts.find(rule);
      EXPECT_LE(count, old == before.counts.end() ? 0 : old->second)
          << allRules()[rule].info.id.str() << "\n"
          << once;
    }
    EXPECT_EQ(once, fixed(session, once, unsafe));
  }
}

std::vector<PageProgram> programsOfOneFile() {
  std::vector<PageProgram> programs;
  for (PageProgram &program : allPagePrograms())
    if (program.files.size() == 1 && program.problem.empty())
      programs.push_back(std::move(program));
  return programs;
}

INSTANTIATE_TEST_SUITE_P(Pages, FixLaws, ::testing::ValuesIn(programsOfOneFile()),
                         [](const auto &info) { return info.param.name(); });

TEST(FixText, CalledProgramsAreThoseOfTheEditor) {
  TemporaryFolder folder;
  const std::string main = (folder.path() / "main.nc").string(),
                    called = (folder.path() / "O0002.nc").string();
  std::ofstream(called) << "O2\nG54\nM99\n";
  SessionOptions options;
  options.dialect = "haas-mill";
  options.profile = "all";
  Session session(std::move(options));
  SourceSet sources;
  const SourceFile &file =
      sources.add(main, llvm::StringRef("O1\nG90 G21 G17\nM98 P2\nG00 X1. Y1.\nM30\n"), main);
  const auto open = std::make_shared<SourceSet::Overlay>();
  (*open)[called] = std::make_shared<const std::string>("O2\nM99\n");
  const auto writesOffset = [](const FixedText &fixed) {
    return fixed.text.find("G54") != std::string::npos;
  };
  EXPECT_FALSE(writesOffset(fixText(session, file, /*unsafe=*/true)));
  EXPECT_TRUE(writesOffset(fixText(session, file, /*unsafe=*/true, open)));
}

TEST(ReplaceFile, KeepsLinksAndPermissions) {
  TemporaryFolder folder;
  const std::string file = (folder.path() / "a.nc").string(),
                    link = (folder.path() / "link.nc").string();
  std::ofstream(file) << "M30\n";
  std::filesystem::create_symlink(file, link);
  std::filesystem::permissions(file, std::filesystem::perms(0640));
  ASSERT_FALSE(llvm::errorToBool(replaceFile(link, "M5\r\nM30\r\n")));
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(std::filesystem::perms(0640), std::filesystem::status(file).permissions());
  std::ifstream in(file, std::ios::binary);
  EXPECT_EQ("M5\r\nM30\r\n", std::string(std::istreambuf_iterator<char>(in), {}));
  size_t files = 0;
  for ([[maybe_unused]] const auto &entry : std::filesystem::directory_iterator(folder.path()))
    ++files;
  EXPECT_EQ(2u, files); // nothing temporary stays
}

TEST(ReplaceFile, SaysWhatCannotBeWritten) {
  TemporaryFolder folder;
  EXPECT_EQ("cannot write " + (folder.path() / "none.nc").string() + ": No such file or directory",
            llvm::toString(replaceFile((folder.path() / "none.nc").string(), "M30\n")));
}

} // namespace
} // namespace ncvet::test
