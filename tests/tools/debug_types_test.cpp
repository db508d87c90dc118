// Holds what the debug adapter sends in the tests to the types of the protocol: those of the npm
// package @vscode/debugprotocol, compiled by TypeScript. Skipped where npm cannot fetch them.
#include "tests/support/debug_client.h"
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include <set>

using namespace ncvet::test;

namespace {

namespace fs = std::filesystem;

const fs::path debugProtocol =
    fs::path(ncvet::places::sourceFolder()) / "lsp" / "editors" / "vscode";

/// Commands that the adapter answers, all of which the tests ask for.
const std::set<std::string> debugCommands = {"initialize",
                                             "launch",
                                             "configurationDone",
                                             "setBreakpoints",
                                             "threads",
                                             "stackTrace",
                                             "setFunctionBreakpoints",
                                             "setExceptionBreakpoints",
                                             "scopes",
                                             "variables",
                                             "setVariable",
                                             "setExpression",
                                             "evaluate",
                                             "gotoTargets",
                                             "goto",
                                             "exceptionInfo",
                                             "loadedSources",
                                             "breakpointLocations",
                                             "continue",
                                             "next",
                                             "stepIn",
                                             "stepOut",
                                             "stepBack",
                                             "reverseContinue",
                                             "pause",
                                             "restart",
                                             "terminate",
                                             "disconnect"};

/// A constant of its type for each message, each form once; `answered` gets the commands.
std::string typedDebugMessages(const fs::path &record, std::set<std::string> &answered) {
  std::ifstream in(record);
  std::string source = "import { DebugProtocol } from '@vscode/debugprotocol';\n";
  std::set<std::string> known;
  for (std::string line; std::getline(in, line);) {
    const Json message = Json::parse(line);
    const bool isEvent = message["type"] == "event";
    if (!isEvent && !message["success"].get<bool>())
      continue; // the types of a request that fails are those of `ErrorResponse`
    std::string name = message[isEvent ? "event" : "command"];
    if (!isEvent)
      answered.insert(name);
    // The types of literals are those of a message that holds nothing else.
    name[0] = char(std::toupper(name[0]));
    const std::string constant =
        "DebugProtocol." + name + (isEvent ? "Event" : "Response") + " = " + message.dump();
    Json form = message;
    form.erase("seq");
    form.erase("request_seq");
    if (known.insert(form.dump()).second)
      source += "const m" + std::to_string(known.size()) + ": " + constant + ";\n";
  }
  return source;
}

TEST(DebugTypes, EveryMessageOfTheAdapterHasItsType) {
  const auto modules = nodeModules(debugProtocol);
  if (!modules)
    GTEST_SKIP() << "npm cannot fetch the protocol's types: messages are not held to them";
  const TemporaryFolder temporary;
  const fs::path log = temporary.path() / "log", record = temporary.path() / "messages";
  fs::create_directory_symlink(*modules, temporary.path() / "node_modules");
  const std::string own = fs::read_symlink("/proc/self/exe").string();
  ASSERT_EQ(runOuter({"env", debugRecordVariable + ("=" + record.string()), own,
                      "--gtest_filter=DryRun.*"},
                     log, 300),
            0)
      << contentsOf(log);
  std::set<std::string> answered;
  std::ofstream(temporary.path() / "messages.ts") << typedDebugMessages(record, answered);
  EXPECT_EQ(answered, debugCommands);
  EXPECT_EQ(runOuter({"env", "-C", temporary.path().string(), "node",
                      (*modules / "typescript" / "bin" / "tsc").string(), "--noEmit", "--strict",
                      "--module", "nodenext", "--skipLibCheck", "messages.ts"},
                     log, 120),
            0)
      << contentsOf(log);
}

} // namespace
