// Measures what an editor asks for besides the findings after an edit.
#include "editor_rows.h"

#include "tests/support/language_client.h"
#include "tests/support/large_workspace.h"
#include "tests/support/random_edits.h"
#include "tests/support/temporary_folder.h"

#include "edit_kinds.h"
#include "latency_row.h"

#include <algorithm>
#include <cstdio>

namespace ncvet::bench {

namespace {

using namespace ncvet::test;

const std::string openPath = "/nowhere/bench.nc";

Json positionOf(const std::string &text, size_t offset) {
  const auto line = std::count(text.begin(), text.begin() + ptrdiff_t(offset), '\n');
  const size_t begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;
  return {{"line", line}, {"character", offset - begin}};
}

void change(LanguageClient &client, const Json &range, const std::string &text, int version) {
  client.notify("textDocument/didChange",
                {{"textDocument", {{"uri", "file://" + openPath}, {"version", version}}},
                 {"contentChanges", {{{"range", range}, {"text", text}}}}});
}

/// What an editor is offered at a place.
Json actionsAt(LanguageClient &client, const Json &place) {
  return client.request("textDocument/codeAction",
                        {{"textDocument", documentOf(openPath)},
                         {"range", {{"start", place}, {"end", place}}},
                         {"context", {{"diagnostics", Json::array()}, {"triggerKind", 2}}}});
}

bool lightbulbIn(const Bench &bench, size_t lines, const std::string &blocks) {
  const std::string text = surfacingWithFindings(bench.folder, lines);
  LanguageClient client(bench.binary);
  const Json resolved = {{"properties", {"edit"}}};
  client.initialize(
      {{"textDocument", {{"codeAction", {{"resolveSupport", resolved}, {"dataSupport", true}}}}}},
      {{"dialect", "haas-mill"}});
  client.open(openPath, text);
  const Json found = client.diagnostics(openPath);
  Times moves(client.process()), edited(client.process()), chosen(client.process());
  size_t offered = 0;
  for (unsigned i = 0; i < bench.edits; ++i) {
    // Every second place is a finding.
    const Json place = i % 2 ? found[i * 7 % found.size()]["range"]["start"]
                             : at(unsigned(lines / (bench.edits + 2) * (i + 1)), 3);
    moves.begin();
    offered += actionsAt(client, place).size();
    moves.end();
  }
  const Json last = positionOf(text, text.rfind("G0 Z50.") + 6);
  for (unsigned i = 0; i < std::min(bench.edits, 20u); ++i) {
    change(client, {{"start", last}, {"end", last}}, "1", int(i) + 2);
    client.diagnostics(openPath, int(i) + 2);
    edited.begin();
    const Json actions = actionsAt(client, found[i * 7 % found.size()]["range"]["start"]);
    edited.end();
    if (actions.empty() || actions[0].contains("edit"))
      continue;
    chosen.begin();
    client.request("codeAction/resolve", actions[0]);
    chosen.end();
  }
  constexpr double goal = 50, afterAnEdit = 100, whenChosen = 1000;
  printRow(("lightbulb: a move of the cursor, " + blocks).c_str(), goal, moves);
  printRow(("lightbulb: at a finding after an edit, " + blocks).c_str(), afterAnEdit, edited);
  printRow(("lightbulb: a fix is tried and made, " + blocks).c_str(), whenChosen, chosen);
  return offered > 0 && client.shutDown() == 0;
}

bool sameAsFresh(const Bench &bench, const std::string &text, const Json &found) {
  LanguageClient fresh(bench.binary);
  fresh.initialize(Json::object(), {{"dialect", "haas-mill"}});
  fresh.open(openPath, text);
  return fresh.diagnostics(openPath) == found;
}

/// Edits, of which the last ones are taken back again and again, as an editor does it.
class UndoneEdits {
public:
  explicit UndoneEdits(const std::string &text) : random_(1, text) {}

  RandomEdit next(const std::string &text) {
    constexpr size_t most = 10;
    undoing_ = undoing_ ? !done_.empty() : done_.size() >= most;
    RandomEdit edit;
    if (undoing_) {
      edit = done_.back();
      done_.pop_back();
    } else {
      edit = random_.next(text);
      done_.push_back({edit.begin, edit.begin + edit.text.size(),
                       text.substr(edit.begin, edit.end - edit.begin)});
    }
    return edit;
  }

private:
  RandomEdits random_;
  std::vector<RandomEdit> done_; ///< what takes each edit back
  bool undoing_ = false;
};

} // namespace

bool measureLightbulb(const Bench &bench) {
  return lightbulbIn(bench, 100'000, "100,000") && lightbulbIn(bench, 1'000'000, "1,000,000");
}

bool measureManyEdits(const Bench &bench) {
  std::string text = textOf(editKinds().front(), bench.folder);
  LanguageClient client(bench.binary);
  client.initialize(Json::object(), {{"dialect", "haas-mill"}});
  client.open(openPath, text);
  Json found = client.diagnostics(openPath);
  UndoneEdits edits(text);
  Times times(client.process());
  const unsigned count = bench.edits * 50, share = count / 5;
  constexpr unsigned firstEdits = 20; // fill what is kept from one check to the next
  double before = 0;
  bool same = true;
  for (unsigned i = 0; i < count; ++i) {
    if (i == firstEdits)
      before = double(memoryOf(client.process())) / 1024;
    const RandomEdit edit = edits.next(text);
    const Json range = {{"start", positionOf(text, edit.begin)},
                        {"end", positionOf(text, edit.end)}};
    text.replace(edit.begin, edit.end - edit.begin, edit.text);
    times.begin();
    change(client, range, edit.text, int(i) + 2);
    found = client.diagnostics(openPath, int(i) + 2);
    times.end();
    if (i % share == share - 1)
      same = same && sameAsFresh(bench, text, found);
  }
  const std::string what = std::to_string(count) + " random edits, 100,000";
  constexpr double goal = 16, most = 1.1;
  printRow(what.c_str(), goal, times);
  printValue((what + ": MiB at the end").c_str(), before * most,
             double(memoryOf(client.process())) / 1024);
  printValue((what + ": other findings than a fresh check").c_str(), 0, same ? 0 : 1);
  return same && client.shutDown() == 0;
}

bool measureWorkspace(const Bench &bench) {
  constexpr unsigned programs = 2000;
  const LargeWorkspace workspace(programs);
  const TemporaryFolder folder;
  workspace.write(
      [&](const std::string &name, const std::string &text) { folder.write(name, text); });
  LanguageClient client(bench.binary);
  Times first(client.process()), all(client.process());
  first.begin();
  all.begin();
  client.initialize({{"textDocument", {{"diagnostic", Json::object()}}}},
                    {{"dialect", "fanuc-mill"}, {"workspaceDiagnostics", true}},
                    workspaceOf(folder.path()));
  const int64_t wanted = client.ask("workspace/diagnostic", {{"previousResultIds", Json::array()}});
  const std::string open = (folder.path() / "O0007.nc").string();
  client.open(open, workspace.mainProgram(7));
  const bool found =
      !client.request("textDocument/diagnostic", {{"textDocument", documentOf(open)}})["items"]
           .empty();
  first.end();
  const size_t files = client.answer(wanted)["result"]["items"].size();
  all.end();
  constexpr double second = 1000, allGoal = 10 * second, memoryGoal = 300;
  printRow("2,000 files: findings of the open one", second, first);
  printRow("2,000 files: findings of all", allGoal, all);
  printValue("2,000 files: most MiB", memoryGoal,
             double(memoryOf(client.process(), "VmHWM:")) / 1024);
  return found && files == programs && client.shutDown() == 0;
}

bool measureFrames(const Bench &bench) {
  constexpr const char *what = "path of 1,000,000 moves turns: frames a second";
  if (std::system("command -v chromium >/dev/null && command -v node >/dev/null") != 0) {
    printMissing(what, "there is no Chromium, or no Node");
    return true;
  }
  const TemporaryFolder folder;
  const std::string page = (folder.path() / "report.html").string();
  // Frames come when the screen wants one, sixty times a second.
  const std::string steps = folder.write("steps.json", Json({R"((async () => {
    const pane = ncvet.pathPane, next = () => new Promise(requestAnimationFrame), frames = 120;
    let first = 0;
    for (let i = 0; i < 30 + frames; ++i) {
      if (i === 30) first = await next();
      pane.camera.orbit(0.02, 0.002, [0, 0, 1]);
      pane.refresh(true);
      await next();
    }
    return frames * 1000 / (performance.now() - first);
  })())"})
                                                           .dump());
  const std::string report = "'" + bench.binary +
                             "' check --dialect haas-mill --report 'html:" + page + "' '" +
                             bench.folder + "/surfacing-1m.nc' >/dev/null 2>&1";
  const std::string drive = std::string("node '") + NCVET_SOURCE_DIR +
                            "/tests/browser/chromium.mjs' chromium 'file://" + page + "' '" +
                            steps + "' 2>&1";
  static_cast<void>(std::system(report.c_str())); // its status tells of findings
  std::string out;
  if (std::FILE *const pipe = popen(drive.c_str(), "r")) {
    char piece[4096];
    while (const size_t got = std::fread(piece, 1, sizeof piece, pipe))
      out.append(piece, got);
    pclose(pipe);
  }
  const Json answer = Json::parse(out, nullptr, false);
  if (!answer.is_object() || answer["results"].empty() || !answer["results"][0].is_number()) {
    printMissing(what, out.c_str());
    return false;
  }
  constexpr double goal = 60, asGoodAs = 0.99; // clocks of screens are not exact
  printValue(what, goal * asGoodAs, answer["results"][0], /*least=*/true);
  return true;
}

} // namespace ncvet::bench
