// Holds what the server sends in the tests to the types of the protocol: those of the npm package
// vscode-languageserver-protocol, compiled by TypeScript. Skipped where npm cannot fetch them.
#include "lsp/server/server.h"
#include "tests/support/language_client.h"
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include <gmock/gmock.h>

#include <set>

using namespace ncvet::test;

namespace {

namespace fs = std::filesystem;

/// The packages are those of the editor's extension, which speaks the protocol with the server.
const fs::path extension = fs::path(ncvet::places::sourceFolder()) / "lsp" / "editors" / "vscode";

/// Suites in which a `LanguageClient` talks to the server.
constexpr const char *journeys =
    "LanguageServer.*:Features.*:FeaturesOfMills.*:Completions.*:*Settings*:PullDiagnostics.*:"
    "CallingPrograms.*:BrokenConfiguration.*:CodeActions.*:RewritingActions.*:Renamed.*:Called.*-"
    "LanguageServer.ALong*"
    ":*"
    "ComesInParts";

/// A type for each method: what a request answers, what a notification tells.
constexpr const char *typesOfMethods = R"TS(
import * as lsp from 'vscode-languageserver-protocol';

type Result<R> = [R] extends [void] ? null : R;
type Kind<T> =
  T extends lsp.ProtocolRequestType<infer P, infer R, any, any, any>
    ? { params: P; result: Result<R> }
  : T extends lsp.ProtocolRequestType0<infer R, any, any, any>
    ? { params: undefined; result: Result<R> }
  : T extends lsp.ProtocolNotificationType<infer P, any> ? { params: P; result: never }
  : T extends lsp.ProtocolNotificationType0<any> ? { params: undefined; result: never }
  : never;
type Namespaces = typeof lsp;
type Standard = {
  [K in keyof Namespaces as Namespaces[K] extends { method: infer M extends string } ? M : never]:
    Namespaces[K] extends { type: infer T } ? Kind<T> : never
};
type Change<T> = { first: number; removed: number; added: T };
type Curve = { count: number; [column: string]: unknown };
type Path<C> = { version: number; files: string[]; programmed: C; [list: string]: unknown };
type PathAnswer = { id: string; version: number } & ({ path: Path<Curve> } | { change: Path<Change<Curve>> });
type Messages = Standard & {
  'ncvet/path': { params: { textDocument: lsp.TextDocumentIdentifier; previous?: string }; result: PathAnswer };
  '$/progress': { params: { token: lsp.ProgressToken; value: any }; result: never };
};
)TS";

/// Lists are long, their elements are of one type.
void shorten(Json &value) {
  constexpr size_t enough = 20;
  if (value.is_array() && value.size() > enough)
    value.erase(value.begin() + enough, value.end());
  if (value.is_structured())
    for (Json &inner : value)
      shorten(inner);
}

/// A constant of its type for each message, each once; `answered` gets the methods of requests.
std::string typedMessages(const fs::path &record, std::set<std::string> &answered) {
  std::ifstream in(record);
  std::set<std::string> known;
  std::string source = typesOfMethods;
  size_t count = 0;
  for (std::string line; std::getline(in, line);) {
    Json message = Json::parse(line);
    if (message["part"] == "result")
      answered.insert(message["method"]);
    shorten(message["value"]);
    const std::string constant = "Messages[" + message["method"].dump() + "][" +
                                 message["part"].dump() + "] = " + message["value"].dump();
    if (known.insert(constant).second)
      source += "const m" + std::to_string(count++) + ": " + constant + ";\n";
  }
  return source;
}

TEST(ProtocolTypes, EveryMessageOfTheServerHasItsType) {
  const auto modules = nodeModules(extension);
  if (!modules)
    GTEST_SKIP() << "npm cannot fetch the protocol's types: messages are not held to them";
  const TemporaryFolder temporary;
  const fs::path log = temporary.path() / "log", record = temporary.path() / "messages";
  fs::create_directory_symlink(*modules, temporary.path() / "node_modules");
  const std::string own = fs::read_symlink("/proc/self/exe").string();
  ASSERT_EQ(runOuter({"env", recordVariable + ("=" + record.string()), own,
                      std::string("--gtest_filter=") + journeys},
                     log, 300),
            0)
      << contentsOf(log);
  std::set<std::string> answered;
  std::ofstream(temporary.path() / "messages.ts") << typedMessages(record, answered);
  for (const std::string &method : ncvet::lsp::answeredRequests())
    EXPECT_TRUE(answered.count(method)) << "no answer to " << method << " is held to its type";
  EXPECT_EQ(runOuter({"env", "-C", temporary.path().string(), "node",
                      (*modules / "typescript" / "bin" / "tsc").string(), "--noEmit", "--strict",
                      "--module", "nodenext", "--skipLibCheck", "messages.ts"},
                     log, 120),
            0)
      << contentsOf(log);
}

} // namespace
