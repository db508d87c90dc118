// A workspace with more programs than anybody opens: what the user looks at comes first.
#include "tests/support/language_client.h"
#include "tests/support/process.h"
#include "tests/support/sanitized.h"

#include "gtest/gtest.h"

#include <chrono>
#include <fstream>
#include <sstream>

namespace {

using namespace ncvet::test;
using Clock = std::chrono::steady_clock;

/// Half of them are main programs, each of which calls one of the others.
constexpr unsigned programs = sanitized ? 200 : 2000;

std::string nameOf(unsigned number) {
  const std::string digits = std::to_string(number);
  return "O" + std::string(4 - digits.size(), '0') + digits;
}

/// A row of holes for each of three tools; the last cycle is left on where the program ends.
std::string mainProgram(unsigned number) {
  std::string text =
      "%\n" + nameOf(number) + " (PLATE, FANUC 0I-MF)\nN10 G17 G21 G40 G80 G90 G94\n";
  for (unsigned tool = 1; tool <= 3; ++tool) {
    const std::string t = std::to_string(tool);
    text += "T" + t + " M06\nG54 G00 X0. Y0. S1200 M03\nG43 H" + t +
            " Z50. M08\nG81 X10. Y10. Z-10. R2. F200.\n";
    for (unsigned hole = 0; hole < 30; ++hole)
      text += "X" + std::to_string(hole * 7 % 90) + ". Y" + std::to_string(number % 90) + ".\n";
    text +=
        "G80\nM98 P" + std::to_string(number + programs / 2) + "\nG00 Z50. M09\nG91 G28 Z0.\nG90\n";
  }
  return text + "G81 X10. Y10. Z-10. R2. F200.\nM30\n%\n";
}

std::string subprogram(unsigned number) {
  std::string text = "%\n" + nameOf(number) + " (SUB)\n";
  for (unsigned i = 0; i < 50; ++i)
    text +=
        "G01 X" + std::to_string(i * 11 % 90) + ". Y" + std::to_string(i * 5 % 70) + ". F300.\n";
  return text + "G00 Z50.\nM99\n%\n";
}

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
  for (unsigned number = 1; number <= programs / 2; ++number)
    shop.file(nameOf(number) + ".nc", mainProgram(number))
        .file(nameOf(number + programs / 2) + ".nc", subprogram(number + programs / 2));
  LanguageClient client;
  client.initialize({{"textDocument", {{"diagnostic", Json::object()}}}},
                    {{"dialect", "fanuc-mill"}, {"workspaceDiagnostics", true}},
                    workspaceOf(shop.path()));
  const auto start = Clock::now();
  const int64_t all = client.ask("workspace/diagnostic", {{"previousResultIds", Json::array()}});
  const std::string open = (shop.path() / "O0007.nc").string();
  client.open(open, mainProgram(7));
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
