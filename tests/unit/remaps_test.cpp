// Codes that the INI file of a LinuxCNC machine makes.
#include "analyzer/check/checker.h"
#include "tests/support/run_program.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

/// What is found in a program in `programs/`, beside an INI file of this text in the folder
/// above.
std::vector<CheckedFinding> findingsBeside(const std::string &ini, const std::string &text,
                                           const std::string &where = "programs") {
  test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / where);
  std::ofstream((folder.path() / "machine.ini").string()) << ini;
  const std::string file = (folder.path() / where / "part.ngc").string();
  std::ofstream(file) << text;
  SessionOptions options;
  options.dialect = "linuxcnc";
  Session session(std::move(options));
  SourceSet sources;
  auto source = sources.open(file, file);
  if (!source) {
    ADD_FAILURE() << llvm::toString(source.takeError());
    return {};
  }
  const FileOutcome outcome = checkFile(session, sources, **source);
  EXPECT_EQ("", outcome.error);
  return {outcome.findings.begin(), outcome.findings.end()};
}

std::vector<std::string> unknownBeside(const std::string &ini, const std::string &text) {
  std::vector<std::string> unknown;
  for (const CheckedFinding &found : findingsBeside(ini, text))
    if (allRules()[found.finding.rule].info.id.startswith("block-un"))
      unknown.push_back(found.finding.message.substr(0, found.finding.message.find(' ')));
  return unknown;
}

/// The errors and warnings.
std::vector<std::string> gravestOf(const std::vector<CheckedFinding> &findings) {
  std::vector<std::string> messages;
  for (const CheckedFinding &found : findings)
    if (found.finding.severity != Severity::Style)
      messages.push_back(found.finding.message);
  return messages;
}

std::vector<std::string> foundBeside(const std::string &ini, const std::string &text) {
  return gravestOf(findingsBeside(ini, text));
}

std::vector<std::string> foundIn(const std::string &folder, const std::string &text) {
  return gravestOf(findingsBeside("", text, folder));
}

const char *const program = "G21 G90\nM428 P1\nG88.1 X3\nM2\n";

TEST(Remaps, CodesOfTheIniFileAreKnown) {
  EXPECT_EQ((std::vector<std::string>{"`M428`", "`G88.1`"}),
            unknownBeside("[RS274NGC]\nPARAMETER_FILE = sim.var\n", program));
  EXPECT_EQ(0u, unknownBeside("[RS274NGC]\nREMAP=M428 modalgroup=10 argspec=P ngc=switch\n"
                              "REMAP = g88.1  modalgroup=1 argspec=xyz py=bore\n",
                              program)
                    .size());
}

TEST(Remaps, CodesOfLinesThatAreOutOfUseStayUnknown) {
  EXPECT_EQ(
      (std::vector<std::string>{"`G88.1`"}),
      unknownBeside("REMAP=M428 modalgroup=10 ngc=switch\n# REMAP=G88.1 ngc=bore\n", program));
}

TEST(Remaps, ACodeOfTheIniFileTakesTheAxisWordsThatItNames) {
  const std::string ini = "REMAP=G88.1 modalgroup=1 argspec=XYZP ngc=bore\n";
  EXPECT_EQ((std::vector<std::string>{}), foundBeside(ini, "F60 S2000 M3\nG88.1 X0 Y2\nM2\n"));
}

TEST(Remaps, AProgramAmongRemapsIsForAMachineThatMakesCodes) {
  EXPECT_EQ(1u, foundIn("programs", "G21 G90\nM428 P1\nM2\n").size());
  EXPECT_EQ(0u, foundIn("remap_subs", "G21 G90\nM428 P1\nM2\n").size());
}

} // namespace
} // namespace ncvet
