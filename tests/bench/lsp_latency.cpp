// Times the language server at the client's side: how long after an edit its diagnostics come, how
// long hover and completion take, and what the server's memory is at the begin and at the end.
//
//   ncvet_lsp_latency NCVET PROGRAM DIALECT [EDITS [UNDO]]
//
// With UNDO, the last edits are taken back whenever that many have been made, as an editor does it,
// so that a long run does not end with a text in which little of the program is left. At the end a
// second server opens the text as it is then: it must find the same.
#include "tests/support/language_client.h"
#include "tests/support/random_edits.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>

namespace {

using namespace ncvet::test;
using Clock = std::chrono::steady_clock;

struct Times {
  std::vector<double> all;

  void add(Clock::time_point since) {
    all.push_back(std::chrono::duration<double, std::milli>(Clock::now() - since).count());
  }
  void print(const char *what) {
    std::sort(all.begin(), all.end());
    if (!all.empty())
      std::printf("%-12s %6zu times  p50 %7.1f ms  p99 %7.1f ms  most %7.1f ms\n", what, all.size(),
                  all[all.size() / 2], all[all.size() * 99 / 100], all.back());
  }
};

/// Resident memory of a process, KiB.
long memoryOf(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmRSS:", 0) == 0)
      return std::stol(line.substr(6));
  return 0;
}

/// Position of an offset in a text of ASCII.
Json positionAt(const std::vector<size_t> &lines, size_t offset) {
  const auto line = std::upper_bound(lines.begin(), lines.end(), offset) - 1;
  return {{"line", line - lines.begin()}, {"character", offset - *line}};
}

std::vector<size_t> linesOf(const std::string &text) {
  std::vector<size_t> lines{0};
  for (size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
    lines.push_back(at + 1);
  return lines;
}

} // namespace

int main(int argc, char **argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: ncvet_lsp_latency NCVET PROGRAM DIALECT [EDITS [UNDO]]\n");
    return 2;
  }
  std::ifstream in(argv[2], std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  const unsigned edits = argc > 4 ? unsigned(std::stoul(argv[4])) : 500;
  const size_t undoAfter = argc > 5 ? std::stoul(argv[5]) : ~size_t(0);
  const std::string path = "/nowhere/bench.nc";

  LanguageClient client(argv[1]);
  client.initialize(
      {{"textDocument", {{"completion", {{"completionList", {{"itemDefaults", {"editRange"}}}}}}}}},
      {{"dialect", argv[3]}});
  client.open(path, text);
  Json last = client.diagnostics(path);
  RandomEdits random(1, text);
  Times edit, hover, completion;
  std::vector<RandomEdit> done; // what takes each edit back
  bool undoing = false;
  long before = 0;
  for (unsigned i = 0; i < edits; ++i) {
    // The first edits fill what is kept from one check to the next.
    if (i == std::min(edits / 2, 20u))
      before = memoryOf(client.process());
    RandomEdit change;
    undoing = undoing ? !done.empty() : done.size() >= undoAfter;
    if (undoing) {
      change = done.back();
      done.pop_back();
    } else {
      change = random.next(text);
      done.push_back({change.begin, change.begin + change.text.size(),
                      text.substr(change.begin, change.end - change.begin)});
    }
    const std::vector<size_t> lines = linesOf(text);
    const Json range = {{"start", positionAt(lines, change.begin)},
                        {"end", positionAt(lines, change.end)}};
    text = change.applied(text);
    const int version = int(i) + 2;
    const auto sent = Clock::now();
    client.notify("textDocument/didChange",
                  {{"textDocument", {{"uri", "file://" + path}, {"version", version}}},
                   {"contentChanges", {{{"range", range}, {"text", change.text}}}}});
    last = client.diagnostics(path, version);
    edit.add(sent);
    if (i % 5 != 0)
      continue;
    const Json place = {{"textDocument", documentOf(path)}, {"position", range["start"]}};
    auto asked = Clock::now();
    client.request("textDocument/hover", place);
    hover.add(asked);
    asked = Clock::now();
    client.request("textDocument/completion", place);
    completion.add(asked);
  }
  std::printf("%s: %zu lines, %.1f MB\n", argv[2], linesOf(text).size(), double(text.size()) / 1e6);
  edit.print("diagnostics");
  hover.print("hover");
  completion.print("completion");
  std::printf("memory       %ld KiB after the first edits, %ld KiB at the end\n", before,
              memoryOf(client.process()));
  LanguageClient fresh(argv[1]);
  fresh.initialize(Json::object(), {{"dialect", argv[3]}});
  fresh.open(path, text);
  const bool same = fresh.diagnostics(path) == last;
  std::printf("a fresh check of the text at the end finds %s\n",
              same ? "the same" : "OTHER THINGS");
  return same && client.shutDown() == 0 && !::testing::Test::HasFailure() ? 0 : 1;
}
