// ./dev: what its commands install is a group that it knows.
#include "tests/support/places.h"

#include "llvm/Support/MemoryBuffer.h"
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

namespace {

/// All first groups of a pattern's matches.
std::set<std::string> found(const std::string &text, const char *pattern) {
  const std::regex regex(pattern);
  std::set<std::string> all;
  for (std::sregex_iterator one(text.begin(), text.end(), regex), end; one != end; ++one)
    all.insert((*one)[1]);
  return all;
}

TEST(DevScript, KnowsEveryGroupOfPackagesThatItsCommandsInstall) {
  const auto file = llvm::MemoryBuffer::getFile(ncvet::places::sourceFolder() + "/dev");
  ASSERT_TRUE(file);
  const std::string text = (*file)->getBuffer().str();
  const size_t begin = text.find("case $1 in"), end = text.find("esac", begin);
  const std::set<std::string> known =
      found(text.substr(begin, end - begin), R"((\w+)(?= \| [\w |]*\)|\)))");
  const std::set<std::string> wanted = found(text, R"(install_packages (\w+))");
  EXPECT_GE(wanted.size(), 8u);
  for (const std::string &group : wanted)
    EXPECT_TRUE(known.count(group)) << group;
}

} // namespace
