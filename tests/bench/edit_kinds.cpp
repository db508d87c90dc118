// Writes the programs that are edited, and the edits.
#include "edit_kinds.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

namespace ncvet::bench {

namespace {

constexpr size_t hundredThousand = 100'000, million = 1'000'000;

std::string asIs(std::string text) { return text; }

/// What ends a program on every control here, wherever it is cut off.
constexpr const char *ending = "G80\nG0 Z50.\nM30\n%\n";

/// The first lines, with the end of a program.
std::string cutTo(std::string text, size_t lines) {
  size_t at = 0;
  for (size_t i = 0; i < lines && at != std::string::npos; ++i)
    at = text.find('\n', at + 1);
  return at == std::string::npos ? text : text.substr(0, at + 1) + ending;
}

/// The blocks between the head and the end again and again, up to this many lines.
std::string repeatedTo(std::string text, size_t lines) {
  const size_t from = text.find("M8\n"), to = text.find("G0 Z50. M9\n");
  const std::string body = text.substr(from, to - from);
  const auto each = size_t(std::count(body.begin(), body.end(), '\n'));
  text.resize(from);
  text.reserve((lines / each + 1) * body.size() + from);
  for (size_t done = 0; done < lines; done += each)
    text += body;
  return cutTo(std::move(text), lines - 10);
}

std::string shortened(std::string text) { return cutTo(std::move(text), hundredThousand); }
std::string lengthened(std::string text) { return repeatedTo(std::move(text), million); }

/// Contours without compensation: arcs and lines.
std::string uncompensated(const std::string &text) {
  std::string arcs;
  arcs.reserve(text.size());
  for (size_t at = 0; at < text.size();) {
    const size_t end = text.find('\n', at) + 1;
    std::string block = text.substr(at, end - at);
    for (const std::string_view word : {" G41 D4", "G40 "})
      if (const size_t found = block.find(word);
          found != std::string::npos && block.find("G21") == std::string::npos)
        block.erase(found, word.size());
    arcs += block;
    at = end;
  }
  return arcs;
}
std::string arcs(std::string text) { return uncompensated(shortened(std::move(text))); }
std::string manyArcs(std::string text) { return uncompensated(lengthened(std::move(text))); }

/// Every twentieth block that ends so holds its last word twice, a thousand at the most.
std::string withFindings(const std::string &text, std::string_view end) {
  constexpr size_t findings = 1000, distance = 20;
  std::string found;
  found.reserve(text.size() + findings * distance);
  size_t done = 0, count = 0, each = 0;
  for (size_t at = text.find(end); at != std::string::npos && count < findings;
       at = text.find(end, at + 1)) {
    if (++each % distance != 0)
      continue;
    const size_t line = text.find('\n', at), word = text.rfind(' ', line);
    found.append(text, done, line - done).append(text, word, line - word);
    done = line;
    ++count;
  }
  return found.append(text, done);
}
std::string turningWithFindings(std::string text) { return withFindings(text, "G01 Z-18.\n"); }

const std::string millHead = "%\nO1 (CALLS)\nG17 G21 G40 G80 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 "
                             "M3\nG43 H1 Z5.\n";

std::string row(int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += "X" + std::to_string(i) + ".1 Y" + std::to_string(i % 7) + ".2\n";
  return text;
}

/// Blocks that a jump leads through again and again.
std::string ring(std::string) {
  return millHead + "G1 Z-1. F200.\nN1\n" + row(500) + "GOTO1\nM30\n%\n";
}

/// A subprogram of a thousand blocks that is called a hundred times.
std::string called(std::string) {
  std::string text = millHead;
  for (int i = 0; i < 100; ++i)
    text += "G0 X" + std::to_string(i) + ". Y0.\nM98 P2\n";
  return text + "M30\nO2\nG1 Z-1. F200.\n" + row(1000) + "G0 Z5.\nM99\n%\n";
}

/// Subprograms of a thousand blocks, each called once.
std::string withCalls(int programs) {
  std::string text = millHead, bodies;
  for (int i = 1; i <= programs; ++i) {
    text += "G0 X" + std::to_string(i) + ". Y0.\nM98 P" + std::to_string(1000 + i) + "\n";
    bodies += "O" + std::to_string(1000 + i) + "\nG1 Z-1. F200.\n" + row(1000) + "G0 Z5.\nM99\n";
  }
  return text + "M30\n" + bodies + "%\n";
}
std::string calls(std::string) { return withCalls(100); }
std::string manyCalls(std::string) { return withCalls(1000); }

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
  return {at, at + 2, turn % 2 == 0 ? ".3" : ".1"};
}

/// Of the move in the loop: nothing that follows is computed from it.
Edit feedOfMacro(const std::string &text, unsigned turn) {
  const char *const from = turn % 2 == 0 ? "F2400." : "F2500.";
  const size_t at = text.find(from);
  return {at, at + 6, turn % 2 == 0 ? "F2500." : "F2400."};
}

/// After the loops.
Edit endOfMacro(const std::string &text, unsigned turn) {
  const char *const from = turn % 2 == 0 ? "G0 Z50. M9" : "G0 Z51. M9";
  const size_t at = text.find(from);
  return {at, at + 10, turn % 2 == 0 ? "G0 Z51. M9" : "G0 Z50. M9"};
}

/// What is aimed at: a frame of the screen up to 100,000 blocks, 50 ms above, 100 ms where all that
/// follows is another.
constexpr double frame = 16, ofAMillion = 50, ofAll = 100;

const char *const surfacing = "surfacing-1m.nc", *const numbered = "numbered-1m.nc",
                  *const contours = "contours-300k.nc", *const drilling = "drilling-200k.nc",
                  *const macros = "macros-1m.nc";

} // namespace

const std::vector<Kind> &editKinds() {
  static const std::vector<Kind> kinds = {
      {"surfacing, 100,000 blocks", surfacing, "haas-mill", frame, shortened, digit},
      {"surfacing, 1,000,000", surfacing, "haas-mill", ofAMillion, asIs, digit},
      {"N and G1 in every block, 100,000", numbered, "haas-mill", frame, shortened, digit},
      {"N and G1 in every block, 1,000,000", numbered, "haas-mill", ofAMillion, asIs, digit},
      {"arcs, 100,000", contours, "fanuc-0m", frame, arcs, digit},
      {"arcs, 1,000,000", contours, "fanuc-0m", ofAMillion, manyArcs, digit},
      {"drilling, 100,000", drilling, "fanuc-0m", frame, shortened, digit},
      {"drilling, 1,000,000", drilling, "fanuc-0m", ofAMillion, lengthened, digit},
      {"100 subprograms, 100,000", nullptr, "fanuc-mill", frame, calls, digit},
      {"1,000 subprograms, 1,000,000", nullptr, "fanuc-mill", ofAMillion, manyCalls, digit},
      {"macros, 1,000,000 executed: a number computed", macros, "fanuc-0m", ofAll, asIs, digit},
      {"the same: a feed in the loop", macros, "fanuc-0m", ofAMillion, asIs, feedOfMacro},
      {"the same: after the loop", macros, "fanuc-0m", ofAMillion, asIs, endOfMacro},
      {"a block put in and out, 100,000", surfacing, "haas-mill", frame, shortened, insertedBlock},
      {"a block put in and out, 1,000,000", surfacing, "haas-mill", ofAMillion, asIs,
       insertedBlock},
      {"G90, G91 at the top, 100,000", surfacing, "haas-mill", ofAll, shortened, modeAtTheTop},
      {"G90, G91 at the top, 1,000,000", surfacing, "haas-mill", ofAll, asIs, modeAtTheTop},
      {"/G91 in the middle, 100,000", surfacing, "haas-mill", ofAll, shortened, skippedMode},
      {"in a ring of GOTO", nullptr, "fanuc-mill", frame, ring, digitOfRing},
      {"in a subprogram called 100 times", nullptr, "fanuc-mill", frame, called, digitInSubprogram},
      {"in one of 2,000 subprograms, three deep", "subprograms-2k.nc", "fanuc-0m", ofAMillion, asIs,
       digit},
      {"turning with 1,000 findings, 300,000", "turning-300k.nc", "fanuc-0t", ofAMillion,
       turningWithFindings, digit},
      {"contours with many G41, 300,000", contours, "fanuc-0m", ofAMillion, asIs, digit},
  };
  return kinds;
}

std::string textOf(const Kind &kind, const std::string &folder) {
  std::string text;
  if (kind.program) {
    std::ifstream in(folder + "/" + kind.program, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  return kind.make(std::move(text));
}

std::string surfacingWithFindings(const std::string &folder, size_t lines) {
  std::ifstream in(folder + "/" + surfacing, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  return withFindings(cutTo(std::move(text), lines - 10), "1\n");
}

} // namespace ncvet::bench
