// Times kinds of edits at the client of the language server: how long after each the diagnostics of
// the text as it is then come, and the changed stretch of its path: its first piece, and all of it.
//
//   ncvet_edit_latency NCVET FOLDER [EDITS [TEXT]]
//
// FOLDER is that of `ncvet_bench_programs`; with TEXT only the kinds in whose names it is. Each
// kind is a line: 50 and 99 of 100 edits take no longer than the times told, in milliseconds,
// beside what is aimed at for the latter. Every second edit takes back the one before it. A kind
// whose edits take long makes fewer of them: how many is told last.
#include "tests/support/language_client.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <numeric>

namespace {

using namespace ncvet::test;
using Clock = std::chrono::steady_clock;

/// The bytes [begin, end) of a text become others.
struct Edit {
  size_t begin = 0, end = 0;
  std::string text;
};

/// One way of editing a program.
struct Kind {
  const char *name;
  const char *program; ///< in the folder; null: `make` writes it
  const char *dialect;
  double goal; ///< milliseconds, 99 of 100 edits
  std::string (*make)(std::string text);
  Edit (*edit)(const std::string &text, unsigned turn);
};

std::string asIs(std::string text) { return text; }

/// The first hundred thousand lines, with the end of a program.
std::string shortened(std::string text) {
  constexpr size_t lines = 100'000;
  size_t at = 0;
  for (size_t i = 0; i < lines && at != std::string::npos; ++i)
    at = text.find('\n', at + 1);
  return at == std::string::npos ? text : text.substr(0, at + 1) + "G0 Z50.\nM30\n%\n";
}

/// A thousand blocks hold a word twice.
std::string withFindings(std::string text) {
  constexpr size_t findings = 1000;
  const std::string found = "G01 Z-18.\n";
  size_t count = 0, each = 0;
  for (size_t at = text.find(found); at != std::string::npos && count < findings;
       at = text.find(found, at + 1))
    if (++each % 20 == 0) {
      text.insert(at + found.size() - 1, " Z-18.");
      ++count;
    }
  return text;
}

/// Blocks that a jump leads through again and again.
std::string ring(std::string) {
  std::string text = "%\nO1 (RING)\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 "
                     "Z5.\nG1 Z-1. F200.\nN1\n";
  for (int i = 0; i < 500; ++i)
    text += "X" + std::to_string(i) + ".1 Y" + std::to_string(i % 7) + ".2\n";
  return text + "GOTO1\nM30\n%\n";
}

/// A subprogram of a thousand blocks that is called a hundred times.
std::string called(std::string) {
  std::string text = "%\nO1 (CALLS)\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 "
                     "H1 Z5.\n";
  for (int i = 0; i < 100; ++i)
    text += "G0 X" + std::to_string(i) + ". Y0.\nM98 P2\n";
  text += "M30\nO2\nG1 Z-1. F200.\n";
  for (int i = 0; i < 1000; ++i)
    text += "X" + std::to_string(i) + ".1 Y" + std::to_string(i % 7) + ".2\n";
  return text + "G0 Z5.\nM99\n%\n";
}

/// The begin of a line in a part of the text, another one each time.
size_t lineIn(const std::string &text, double part, unsigned turn) {
  const auto at = size_t(double(text.size()) * part) + 97 * turn;
  return text.rfind('\n', std::min(at, text.size() - 2)) + 1;
}

/// The first digit after a point in the middle becomes another one.
Edit digit(const std::string &text, unsigned turn) {
  const auto isDigit = [&](size_t at) {
    return at < text.size() && text[at] >= '0' && text[at] <= '9';
  };
  const size_t begin = lineIn(text, 0.5, turn / 2);
  size_t at = text.find('.', begin);
  while (at != std::string::npos && !isDigit(at + 1))
    at = text.find('.', at + 1);
  if (at == std::string::npos)
    return {begin, begin, ""};
  ++at;
  return {at, at + 1, std::string(1, text[at] == '9' ? '0' : char(text[at] + 1))};
}

Edit insertedBlock(const std::string &text, unsigned turn) {
  const size_t begin = lineIn(text, 0.5, turn / 2), end = text.find('\n', begin) + 1;
  if (turn % 2 == 1)
    return {begin, end, ""};
  return {begin, begin, text.substr(begin, end - begin)};
}

/// Of the first block that says how coordinates are meant.
Edit modeAtTheTop(const std::string &text, unsigned turn) {
  const char *const from = turn % 2 == 0 ? "G90" : "G91";
  const size_t at = text.find(from);
  return {at, at + 3, turn % 2 == 0 ? "G91" : "G90"};
}

Edit skippedMode(const std::string &text, unsigned turn) {
  const std::string block = "/G91\n";
  if (turn % 2 == 1) {
    const size_t at = text.find(block);
    return {at, at + block.size(), ""};
  }
  const size_t begin = lineIn(text, 0.5, turn);
  return {begin, begin, block};
}

/// In the last program of the text; of a short one the same places come again.
Edit digitInSubprogram(const std::string &text, unsigned turn) {
  const size_t at = text.find('1', lineIn(text, 0.8, turn / 2 % 10));
  return {at, at + 1, turn % 2 == 0 ? "2" : "1"};
}

Edit digitOfRing(const std::string &text, unsigned turn) {
  const size_t at = text.find(".1", lineIn(text, 0.5, turn / 2 % 20));
  return {at, at + 2, ".1"};
}

/// What is aimed at: a frame of the screen, 50 ms in a million blocks, 100 ms where all that
/// follows is another.
constexpr double frame = 16, ofAMillion = 50, ofAll = 100;

constexpr Kind kinds[] = {
    {"a coordinate, 100,000 blocks", "surfacing-1m.nc", "haas-mill", frame, shortened, digit},
    {"a coordinate, 1,000,000 blocks", "surfacing-1m.nc", "haas-mill", ofAMillion, asIs, digit},
    {"a block put in and out, 100,000", "surfacing-1m.nc", "haas-mill", frame, shortened,
     insertedBlock},
    {"a block put in and out, 1,000,000", "surfacing-1m.nc", "haas-mill", ofAMillion, asIs,
     insertedBlock},
    {"G90, G91 at the top, 100,000", "surfacing-1m.nc", "haas-mill", ofAll, shortened,
     modeAtTheTop},
    {"G90, G91 at the top, 1,000,000", "surfacing-1m.nc", "haas-mill", ofAll, asIs, modeAtTheTop},
    {"/G91 in the middle, 100,000", "surfacing-1m.nc", "haas-mill", ofAll, shortened, skippedMode},
    {"N and G1 in every block, 1,000,000", "numbered-1m.nc", "haas-mill", ofAMillion, asIs, digit},
    {"contours with G41, 300,000", "contours-300k.nc", "fanuc-0m", ofAMillion, asIs, digit},
    {"drilling, 200,000", "drilling-200k.nc", "fanuc-0m", ofAMillion, asIs, digit},
    {"turning with 1,000 findings, 300,000", "turning-300k.nc", "fanuc-0t", ofAMillion,
     withFindings, digit},
    {"in a ring of GOTO", nullptr, "fanuc-mill", frame, ring, digitOfRing},
    {"in a subprogram called 100 times", nullptr, "fanuc-mill", frame, called, digitInSubprogram},
    {"macros, 1,000,000 executed blocks", "macros-1m.nc", "fanuc-0m", ofAll, asIs, digit},
    {"in one of 2,000 subprograms", "subprograms-2k.nc", "fanuc-0m", ofAll, asIs, digit},
};

Json positionOf(const std::string &text, size_t offset) {
  const auto line = std::count(text.begin(), text.begin() + ptrdiff_t(offset), '\n');
  const size_t begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;
  return {{"line", line}, {"character", offset - begin}};
}

class Times {
public:
  void add(Clock::time_point since) {
    all_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - since).count());
  }
  size_t count() const { return all_.size(); }
  double sum() const { return std::accumulate(all_.begin(), all_.end(), 0.0); }
  double at(size_t percent) {
    std::sort(all_.begin(), all_.end());
    return all_.empty() ? 0 : all_[std::min(all_.size() - 1, all_.size() * percent / 100)];
  }

private:
  std::vector<double> all_;
};

/// The first edits fill what is kept from one check to the next: they do not count.
constexpr unsigned warmUp = 4;
/// Milliseconds after which no further path is asked for, and no further edit made: where all that
/// follows an edit is another, each takes as long as the one before.
constexpr double enoughOfPaths = 4000, enoughOfEdits = 20'000;

bool measure(const char *binary, const std::string &folder, const Kind &kind, unsigned edits) {
  std::string text;
  if (kind.program) {
    std::ifstream in(folder + "/" + kind.program, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  text = kind.make(std::move(text));
  const std::string path = "/nowhere/bench.nc";
  LanguageClient client(binary);
  client.initialize(Json::object(), {{"dialect", kind.dialect}});
  client.open(path, text);
  client.diagnostics(path);
  const auto ask = [&](const std::string &previous) {
    return client.request(
        "ncvet/path",
        {{"textDocument", documentOf(path)}, {"previous", previous}, {"pieces", true}});
  };
  std::string pathId = ask("")["id"];
  Times findings, firsts, paths;
  for (unsigned i = 0; i < warmUp + edits && findings.sum() < enoughOfEdits; ++i) {
    const Edit edit = kind.edit(text, i);
    const Json range = {{"start", positionOf(text, edit.begin)},
                        {"end", positionOf(text, edit.end)}};
    text.replace(edit.begin, edit.end - edit.begin, edit.text);
    const int version = int(i) + 2;
    const auto sent = Clock::now();
    client.notify("textDocument/didChange",
                  {{"textDocument", {{"uri", "file://" + path}, {"version", version}}},
                   {"contentChanges", {{{"range", range}, {"text", edit.text}}}}});
    client.diagnostics(path, version);
    if (i >= warmUp)
      findings.add(sent);
    if (paths.sum() > enoughOfPaths)
      continue;
    const auto asked = Clock::now();
    Json answer = ask(pathId);
    if (i >= warmUp)
      firsts.add(asked);
    while (answer.contains("more"))
      answer = ask(answer["id"]);
    if (i >= warmUp)
      paths.add(asked);
    pathId = answer["id"];
  }
  const double worst = findings.at(99);
  std::printf("%-38s %8.1f %8.1f %8.0f  %-7s %8.1f %8.1f %8.1f %6zu\n", kind.name, findings.at(50),
              worst, kind.goal, worst <= kind.goal ? "" : "missed", firsts.at(50), firsts.at(99),
              paths.at(99), findings.count());
  std::fflush(stdout);
  return client.shutDown() == 0;
}

} // namespace

int main(int argc, char **argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: ncvet_edit_latency NCVET FOLDER [EDITS [TEXT]]\n");
    return 2;
  }
  const unsigned edits = argc > 3 ? unsigned(std::stoul(argv[3])) : 200;
  const std::string only = argc > 4 ? argv[4] : "";
  std::printf("%-38s %8s %8s %8s  %-7s %8s %8s %8s %6s\n", "edit (ms until its findings; its path)",
              "p50", "p99", "goal", "", "path p50", "p99", "all p99", "edits");
  bool fine = true;
  for (const Kind &kind : kinds)
    if (std::string(kind.name).find(only) != std::string::npos)
      fine &= measure(argv[1], argv[2], kind, edits);
  return fine && !::testing::Test::HasFailure() ? 0 : 1;
}
