// The documentation as a static site: it is made, its links lead somewhere, and pages of rules are
// for readers.
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"

namespace {

namespace fs = std::filesystem;
using namespace ncvet::test;

TEST(DocumentationSite, IsMadeWithoutABrokenLink) {
  // Debian's own Python has Debian's packages.
  const std::string python = "/usr/bin/python3";
  const TemporaryFolder temporary;
  const fs::path log = temporary.path() / "log", site = temporary.path() / "site";
  if (runOuter({python, "-c", "import markdown"}, log, 30) != 0)
    GTEST_SKIP() << "python3-markdown is not installed";
  ASSERT_EQ(
      runOuter({python, "-B", ncvet::places::sourceFolder() + "/docs/site/site.py", site.string()},
               log, 60),
      0)
      << contentsOf(log);
  const std::string page = contentsOf(site / "rules" / "cycle-left-active.html");
  EXPECT_NE(page.find("T303 (DRILL 8)"), std::string::npos);
  for (const fs::directory_entry &rule : fs::directory_iterator(site / "rules"))
    EXPECT_EQ(contentsOf(rule.path()).find("expect:"), std::string::npos)
        << rule.path() << ": marks of tests are for tests";
  EXPECT_EQ(page.find("&quot;summary&quot;"), std::string::npos) << "so is the head of the page";
  EXPECT_NE(contentsOf(site / "index.js").find("cycle-left-active"), std::string::npos);
}

} // namespace
