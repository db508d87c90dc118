// Times an editor's work at the client of the language server: how long after an edit the
// diagnostics of the text as it is then come, and the changed stretch of its path, its first piece
// and all of it; code actions; a workspace; and how the path is drawn.
//
//   ncvet_edit_latency NCVET FOLDER [EDITS [TEXT]]
//
// FOLDER is that of `ncvet_bench_programs`; with TEXT only the rows in whose names it is. Every
// second edit takes back the one before it. A kind whose edits take long makes fewer of them: how
// many is told last. The time of the processors is told beside that of the clock: other work on the
// machine does not change it.
#include "tests/support/language_client.h"

#include "edit_kinds.h"
#include "editor_rows.h"
#include "latency_row.h"

#include <algorithm>
#include <cstdio>

namespace {

using namespace ncvet::bench;
using namespace ncvet::test;

Json positionOf(const std::string &text, size_t offset) {
  const auto line = std::count(text.begin(), text.begin() + ptrdiff_t(offset), '\n');
  const size_t begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;
  return {{"line", line}, {"character", offset - begin}};
}

/// The first edits fill what is kept from one check to the next: they do not count.
constexpr unsigned warmUp = 4;
/// Milliseconds after which no further path is asked for, and no further edit made: where all that
/// follows an edit is another, each takes as long as the one before.
constexpr double enoughOfPaths = 4000, enoughOfEdits = 10'000;

const std::string path = "/nowhere/bench.nc";

/// The path that an editor shows, carried from one version of the text to the next.
class ShownPath {
public:
  explicit ShownPath(LanguageClient &client) : client_(client) {}

  bool isEnough() const { return all_.sum() > enoughOfPaths; }
  void follow(bool counts) {
    first_.begin();
    all_.begin();
    Json answer = ask(id_);
    if (counts)
      first_.end();
    while (answer.contains("more"))
      answer = ask(answer["id"]);
    if (counts)
      all_.end();
    id_ = answer["id"];
  }
  void print() const {
    constexpr double goal = 100;
    printRow("  its path: first piece", goal, first_);
    printRow("  its path: whole", goal, all_);
  }

private:
  Json ask(const std::string &previous) {
    return client_.request(
        "ncvet/path",
        {{"textDocument", documentOf(path)}, {"previous", previous}, {"pieces", true}});
  }

  LanguageClient &client_;
  std::string id_;
  Times first_{client_.process()}, all_{client_.process()};
};

bool measure(const Bench &bench, const Kind &kind) {
  std::string text = textOf(kind, bench.folder);
  LanguageClient client(bench.binary);
  client.initialize(Json::object(), {{"dialect", kind.dialect}});
  client.open(path, text);
  client.diagnostics(path);
  ShownPath shown(client);
  shown.follow(false);
  Times findings(client.process());
  for (unsigned i = 0; i < warmUp + bench.edits && findings.sum() < enoughOfEdits; ++i) {
    const Edit edit = kind.edit(text, i);
    const Json range = {{"start", positionOf(text, edit.begin)},
                        {"end", positionOf(text, edit.end)}};
    text.replace(edit.begin, edit.end - edit.begin, edit.text);
    const int version = int(i) + 2;
    findings.begin();
    client.notify("textDocument/didChange",
                  {{"textDocument", {{"uri", "file://" + path}, {"version", version}}},
                   {"contentChanges", {{{"range", range}, {"text", edit.text}}}}});
    client.diagnostics(path, version);
    if (i >= warmUp)
      findings.end();
    if (!shown.isEnough())
      shown.follow(i >= warmUp);
  }
  printRow(kind.name, kind.goal, findings);
  shown.print();
  return client.shutDown() == 0;
}

struct OtherRows {
  const char *name;
  bool (*measure)(const Bench &bench);
};
constexpr OtherRows others[] = {
    {"lightbulb", measureLightbulb},
    {"random edits", measureManyEdits},
    {"2,000 files", measureWorkspace},
    {"frames", measureFrames},
};

} // namespace

int main(int argc, char **argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: ncvet_edit_latency NCVET FOLDER [EDITS [TEXT]]\n");
    return 2;
  }
  const Bench bench{argv[1], argv[2], argc > 3 ? unsigned(std::stoul(argv[3])) : 200};
  const std::string only = argc > 4 ? argv[4] : "";
  const auto isWanted = [&](const char *name) {
    return std::string(name).find(only) != std::string::npos;
  };
  printHead();
  bool fine = true;
  for (const Kind &kind : editKinds())
    if (isWanted(kind.name))
      fine &= measure(bench, kind);
  for (const OtherRows &rows : others)
    if (isWanted(rows.name))
      fine &= rows.measure(bench);
  return fine && !::testing::Test::HasFailure() ? 0 : 1;
}
