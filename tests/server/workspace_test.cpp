// A workspace with more programs than anybody opens: what the user looks at comes first.
#include "tests/support/language_client.h"
#include "tests/support/large_workspace.h"
#include "tests/support/process.h"
#include "tests/support/sanitized.h"

#include "gtest/gtest.h"

#include <chrono>
#include <fstream>
#include <sstream>

namespace {

using namespace ncvet::test;
using Clock = std::chrono::steady_clock;

constexpr unsigned programs = sanitized ? 200 : 2000;

/// Peak of the resident memory, MiB.
long peakOf(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0)
      return std::stol(line.substr(6)) / 1024;
  return 0;
}

/// Seconds of the processors that a process has used.
double secondsOf(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  std::getline(stat, line);
  std::istringstream fields(line.substr(line.rfind(')') + 2));
  std::vector<std::string> all{std::istream_iterator<std::string>(fields), {}};
  return double(std::stol(all.at(11)) + std::stol(all.at(12))) / double(::sysconf(_SC_CLK_TCK));
}

TEST(Workspace, OfTwoThousandProgramsDoesNotKeepTheOpenOneWaiting) {
  Shop shop;
  const LargeWorkspace workspace(programs);
  workspace.write([&](const std::string &name, const std::string &text) { shop.file(name, text); });
  LanguageClient client;
  client.initialize({{"textDocument", {{"diagnostic", Json::object()}}}},
                    {{"dialect", "fanuc-mill"}, {"workspaceDiagnostics", true}},
                    workspaceOf(shop.path()));
  const auto start = Clock::now();
  const int64_t all = client.ask("workspace/diagnostic", {{"previousResultIds", Json::array()}});
  const std::string open = (shop.path() / "O0007.nc").string();
  client.open(open, workspace.mainProgram(7));
  const Json here = {{"textDocument", documentOf(open)}};
  EXPECT_FALSE(client.request("textDocument/diagnostic", here)["items"].empty());
  Json hover = here;
  hover["position"] = at(10, 2);
  EXPECT_FALSE(client.request("textDocument/hover", hover).is_null());
  const auto first = Clock::now() - start;
  EXPECT_EQ(client.answer(all)["result"]["items"].size(), programs);
  // A ratio, which the machine's other work does not change: the first took 0.1 s, all of it 2 s.
  EXPECT_LT(first * 4, Clock::now() - start);
  EXPECT_LT(peakOf(client.process()), 300);
  EXPECT_LT(secondsOf(client.process()), 10);
}

} // namespace
