// Holds every source file to the table of rooms: what it may include, and that it says what it is
// for.
#include "tests/support/places.h"

#include "gtest/gtest.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// A room: a folder, and the rooms whose headers its files may include.
struct Layer {
  std::string folder; ///< prefix of a path, with `/` at the end
  std::vector<std::string> never;
  std::set<std::string> mayInclude;
};

std::vector<std::string> wordsOf(const std::string &line) {
  std::istringstream stream(line.substr(0, line.find('#')));
  return {std::istream_iterator<std::string>(stream), {}};
}

/// The lines of the table of rooms, as words; comments and empty lines left out.
std::vector<std::vector<std::string>> tableOfRooms() {
  std::vector<std::vector<std::string>> rows;
  std::ifstream stream(fs::path(ncvet::places::sourceFolder()) / "tests/shape/rooms.txt");
  for (std::string line; std::getline(stream, line);)
    if (std::vector<std::string> words = wordsOf(line); !words.empty())
      rows.push_back(std::move(words));
  return rows;
}

bool isIn(std::string_view path, std::string_view folder) {
  return path.substr(0, folder.size()) == folder;
}

/// The table of rooms, as `./dev shape` reads it: a room includes the ones above it in the table.
const std::vector<Layer> &layers() {
  static const std::vector<Layer> table = [] {
    std::vector<Layer> rooms;
    for (const std::vector<std::string> &words : tableOfRooms()) {
      Layer &room = rooms.emplace_back();
      room.folder = words[0] + "/";
      for (size_t i = 2; i < words.size(); ++i) // after `not`
        room.never.push_back(words[i] + "/");
      for (const Layer &above : rooms)
        if (std::none_of(room.never.begin(), room.never.end(),
                         [&](const std::string &never) { return isIn(above.folder, never); }))
          room.mayInclude.insert(above.folder);
    }
    return rooms;
  }();
  return table;
}

/// The room with the longest folder that a path lies in.
const Layer *layerOf(std::string_view path) {
  const Layer *found = nullptr;
  for (const Layer &layer : layers())
    if (isIn(path, layer.folder) && (!found || layer.folder.size() > found->folder.size()))
      found = &layer;
  return found;
}

/// True for a folder of this project; everything else is a library.
bool isProjectPath(std::string_view path) {
  for (std::string_view top : {"formats/", "interp/", "analyzer/", "rules/", "lsp/", "tests/"})
    if (path.substr(0, top.size()) == top)
      return true;
  return false;
}

/// Libraries whose headers are written in quotes.
bool isLibraryPath(std::string_view path) {
  for (std::string_view top : {"llvm/", "gtest/", "gmock/", "nlohmann/", "benchmark/", "Eigen/"})
    if (path.substr(0, top.size()) == top)
      return true;
  return false;
}

/// Ids of `--dialect`. Code asks the dialect's table and never for its name: a new control of a
/// known family is a JSON file and no C++.
const std::set<std::string, std::less<>> &dialectIds() {
  static const std::set<std::string, std::less<>> ids = [] {
    std::set<std::string, std::less<>> names;
    for (const auto &table :
         fs::directory_iterator(fs::path(ncvet::places::sourceFolder()) / "rulesets/dialects"))
      names.insert(table.path().stem().string());
    return names;
  }();
  return ids;
}

/// Rules are told by the table, the interpreter by actions, the engine by both: none by a name.
bool mustNotNameDialects(std::string_view path) {
  return isIn(path, "interp/") || isIn(path, "rules/") ||
         (isIn(path, "analyzer/") && !isIn(path, "analyzer/cli/"));
}

/// Header → what must not be included, and where. `interp/` is pure: no files and no output.
bool forbiddenHeader(std::string_view path, std::string_view header) {
  if (header == "llvm/Support/JSON.h")
    return true; // does not compile with clang 14 in C++20, and is slow
  const bool isHeader = path.size() > 2 && path.substr(path.size() - 2) == ".h";
  // A second of compile time for everybody who includes it: .cpp files only, and the headers of the
  // geometry itself.
  if (isHeader && header.substr(0, 6) == "Eigen/" && !isIn(path, "interp/geometry/"))
    return true;
  // The messages of the language server are JSON; its features are not.
  const bool inFeatures = path.substr(0, 13) == "lsp/features/";
  const bool inServer = path.substr(0, 4) == "lsp/" && !inFeatures;
  if (header == "nlohmann/json.hpp" && (inFeatures || (isHeader && !inServer)))
    return true;
  if (path.substr(0, 7) != "interp/")
    return false;
  return header == "iostream" || header == "fstream" || header == "filesystem" ||
         header == "cstdio" || header == "llvm/Support/FileSystem.h" ||
         header == "llvm/Support/MemoryBuffer.h";
}

/// The rooms that calculate with angles: the geometry, which the others ask, and the functions of
/// the controls' own language.
bool mayCalculateAngles(std::string_view path) {
  return isIn(path, "interp/geometry/") || isIn(path, "interp/evaluate/");
}

/// A function of trigonometry in a line of code, or the number pi; empty without one.
std::string trigonometryIn(const std::string &line) {
  static const std::regex function(
      R"(\bstd::(sin|cos|tan|asin|acos|atan|atan2|hypot|numbers)\b|\bM_PI\b)");
  const std::string code = line.substr(0, line.find("//"));
  std::smatch match;
  return std::regex_search(code, match, function) ? match[0].str() : std::string();
}

/// What a line of code holds beside comments: the header that it includes, and its string literals.
struct Line {
  std::string header;
  bool quoted = false;
  std::vector<std::string> literals;
};

Line readLine(const std::string &text) {
  Line line;
  static const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::smatch match;
  if (std::regex_search(text, match, include)) {
    line.quoted = match[1] == "\"";
    line.header = match[2];
    return line;
  }
  for (size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "//") == 0)
      break;
    if (text[i] == '\'' && i + 2 < text.size()) { // a character, which may be a quotation mark
      i += text[i + 1] == '\\' ? 3 : 2;
      continue;
    }
    if (text[i] != '"')
      continue;
    const size_t begin = ++i;
    while (i < text.size() && text[i] != '"')
      i += text[i] == '\\' ? 2 : 1;
    line.literals.push_back(text.substr(begin, std::min(i, text.size()) - begin));
  }
  return line;
}

/// A file opens with `// ` and a sentence that ends in a full stop, perhaps lines later.
bool opensWithSentence(const std::vector<std::string> &lines) {
  std::string comment;
  for (const std::string &line : lines) {
    if (line.compare(0, 3, "// ") != 0)
      break;
    comment += line.substr(3) + " ";
  }
  while (!comment.empty() && comment.back() == ' ')
    comment.pop_back();
  return comment.size() >= 20 && comment.back() == '.';
}

std::vector<std::string> splitLines(const std::string &text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

/// Everything in which one file breaks the table, each as `path:line: what`.
std::vector<std::string> violations(const std::string &path, const std::string &text) {
  std::vector<std::string> found;
  const Layer *layer = layerOf(path);
  auto report = [&](size_t line, const std::string &what) {
    found.push_back(path + ":" + std::to_string(line) + ": " + what);
  };
  if (!layer) {
    report(1, "lies in no room of tests/shape/rooms.txt");
    return found;
  }
  const std::vector<std::string> lines = splitLines(text);
  if (!opensWithSentence(lines))
    report(1, "does not open with a comment of one sentence on what the file is for");
  for (size_t i = 0; i < lines.size(); ++i) {
    const Line line = readLine(lines[i]);
    if (const std::string angle = trigonometryIn(lines[i]);
        !angle.empty() && !mayCalculateAngles(path))
      report(i + 1, "calls " + angle + "; a function of interp/geometry does");
    if (!line.header.empty()) {
      if (forbiddenHeader(path, line.header))
        report(i + 1, "may not include " + line.header);
      if (!isProjectPath(line.header)) {
        if (line.quoted && !isLibraryPath(line.header))
          report(i + 1, "includes " + line.header + " not by its path from the top");
        continue;
      }
      const Layer *target = layerOf(line.header);
      if (!target || layer->mayInclude.count(target->folder) == 0)
        report(i + 1, "may not include " + line.header);
    }
    if (!mustNotNameDialects(path))
      continue;
    for (const std::string &literal : line.literals)
      if (dialectIds().count(literal) != 0)
        report(i + 1, "names the dialect \"" + literal + "\"; ask its table instead");
  }
  return found;
}

std::string readFile(const fs::path &path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Path from the top of the project → text, of every source file of the product.
const std::map<std::string, std::string> &sources() {
  static const std::map<std::string, std::string> files = [] {
    std::map<std::string, std::string> result;
    const fs::path root = ncvet::places::sourceFolder();
    for (const char *top : {"formats", "interp", "analyzer", "rules", "lsp"}) {
      if (!fs::exists(root / top))
        continue;
      for (const fs::directory_entry &entry : fs::recursive_directory_iterator(root / top))
        if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
          result[entry.path().lexically_relative(root).generic_string()] = readFile(entry.path());
    }
    return result;
  }();
  return files;
}

std::string join(const std::vector<std::string> &lines) {
  std::string text;
  for (const std::string &line : lines)
    text += line + "\n";
  return text;
}

/// First cycle of includes that is reachable from `path`, as `a -> b -> a`; empty when there is
/// none.
std::string findCycle(const std::map<std::string, std::vector<std::string>> &graph,
                      const std::string &path, std::vector<std::string> &stack,
                      std::set<std::string> &done) {
  const auto seen = std::find(stack.begin(), stack.end(), path);
  if (seen != stack.end()) {
    std::string cycle;
    for (auto it = seen; it != stack.end(); ++it)
      cycle += *it + " -> ";
    return cycle + path;
  }
  const auto node = graph.find(path);
  if (node == graph.end() || !done.insert(path).second)
    return "";
  stack.push_back(path);
  for (const std::string &next : node->second) {
    std::string cycle = findCycle(graph, next, stack, done);
    if (!cycle.empty())
      return cycle;
  }
  stack.pop_back();
  return "";
}

std::string findCycle(const std::map<std::string, std::vector<std::string>> &graph) {
  std::set<std::string> done;
  for (const auto &node : graph) {
    std::vector<std::string> stack;
    std::string cycle = findCycle(graph, node.first, stack, done);
    if (!cycle.empty())
      return cycle;
  }
  return "";
}

const std::string sentence = "// Says what this file is for.\n";

TEST(Layering, EveryFileIncludesOnlyWhatItsLayerMay) {
  ASSERT_FALSE(sources().empty());
  std::vector<std::string> found;
  for (const auto &[path, text] : sources()) {
    const std::vector<std::string> here = violations(path, text);
    found.insert(found.end(), here.begin(), here.end());
  }
  EXPECT_TRUE(found.empty()) << join(found);
}

/// What would let a rule remember something beside its memory.
TEST(Layering, NoRuleChangesWhatIsConst) {
  const std::regex loophole("\\b(mutable [A-Za-z]|const_cast<)");
  std::vector<std::string> found;
  for (const auto &[path, text] : sources())
    if (isIn(path, "rules/") && std::regex_search(text, loophole))
      found.push_back(path + ": keeps something beside its memory");
  EXPECT_TRUE(found.empty()) << join(found);
}

TEST(Layering, NoHeadersIncludeEachOtherInACycle) {
  std::map<std::string, std::vector<std::string>> graph;
  for (const auto &[path, text] : sources()) {
    std::vector<std::string> &edges = graph[path];
    for (const std::string &line : splitLines(text))
      if (const Line read = readLine(line); isProjectPath(read.header))
        edges.push_back(read.header);
  }
  EXPECT_EQ(findCycle(graph), "");
}

TEST(Layering, EveryIncludedProjectHeaderExists) {
  std::vector<std::string> found;
  for (const auto &[path, text] : sources())
    for (const std::string &line : splitLines(text))
      if (const Line read = readLine(line);
          isProjectPath(read.header) && sources().count(read.header) == 0)
        found.push_back(path + ": there is no " + read.header);
  EXPECT_TRUE(found.empty()) << join(found);
}

TEST(Layering, ACycleOfIncludesIsSeen) {
  EXPECT_EQ(findCycle({{"a.h", {"b.h"}}, {"b.h", {"c.h"}}, {"c.h", {}}}), "");
  EXPECT_EQ(findCycle({{"a.h", {"b.h"}}, {"b.h", {"c.h"}}, {"c.h", {"b.h"}}}), "b.h -> c.h -> b.h");
}

TEST(Layering, AnIncludeOfARowBelowIsSeenWithItsLine) {
  EXPECT_EQ(
      violations("formats/readers/x.cpp", sentence + "#include \"formats/reports/y.h\"\n"),
      std::vector<std::string>{"formats/readers/x.cpp:2: may not include formats/reports/y.h"});
  EXPECT_EQ(violations("interp/x.h", sentence + "\n  #  include <formats/finding/finding.h>\n"),
            std::vector<std::string>{"interp/x.h:3: may not include formats/finding/finding.h"});
  EXPECT_EQ(violations("formats/reports/x.h", sentence + "#include \"analyzer/check/analyze.h\"\n")
                .size(),
            1U);
}

TEST(Layering, NobodyButTheCommandLineIncludesTheServerOrTheCommandLine) {
  for (const std::string path :
       {"formats/text/x.cpp", "interp/x.cpp", "analyzer/x.cpp", "rules/cycle/x.cpp"})
    for (const std::string include :
         {"#include \"lsp/server.h\"\n", "#include \"analyzer/cli/options.h\"\n"})
      EXPECT_EQ(violations(path, sentence + include).size(), 1U) << path << " " << include;
  EXPECT_EQ(violations("lsp/x.cpp", sentence + "#include \"analyzer/cli/options.h\"\n").size(), 1U);
  EXPECT_TRUE(violations("analyzer/cli/x.cpp", sentence + "#include \"lsp/server.h\"\n").empty());
}

TEST(Layering, ARuleThatIncludesAnotherRuleIsSeen) {
  EXPECT_EQ(violations("rules/cycle/a.cpp", sentence + "#include \"rules/cycle/b.h\"\n").size(),
            1U);
  EXPECT_TRUE(
      violations("rules/cycle/a.cpp", sentence + "#include \"analyzer/rule/rule.h\"\n").empty());
}

TEST(Layering, ADialectNamedInCodeIsSeenAndInACommentIsNot) {
  EXPECT_EQ(violations("interp/x.cpp", sentence + "if (id == \"haas-lathe\") // \"ecs\"\n"),
            std::vector<std::string>{
                "interp/x.cpp:2: names the dialect \"haas-lathe\"; ask its table instead"});
  EXPECT_EQ(violations("analyzer/setup/detect.cpp", sentence + "return \"fanuc-0m\";\n").size(),
            1U);
  EXPECT_EQ(violations("rules/tool/x.cpp", sentence + "c == '\"' ? \"mefi\" : \"\";\n").size(), 1U);
  EXPECT_TRUE(violations("analyzer/cli/x.cpp", sentence + "return \"haas-lathe\";\n").empty());
  EXPECT_TRUE(violations("rules/flow/x.cpp", sentence + "id == \"ecs-input-unchecked\"\n").empty());
}

TEST(Layering, AFileWithoutAnOpeningSentenceIsSeen) {
  EXPECT_EQ(violations("interp/x.cpp", "#pragma once\n").size(), 1U);
  EXPECT_EQ(violations("interp/x.cpp", "// TODO\n").size(), 1U);
  EXPECT_TRUE(
      violations("interp/x.cpp", "// A sentence that goes on\n// in a second line.\n").empty());
}

TEST(Layering, TrigonometryOutsideOfTheGeometryIsSeen) {
  const std::string call = sentence + "const double x = std::cos(angle);\n";
  EXPECT_EQ(violations("rules/arc/x.cpp", call).size(), 1U);
  EXPECT_EQ(violations("interp/execute/x.cpp", sentence + "return std::numbers::pi;\n").size(), 1U);
  EXPECT_TRUE(violations("rules/arc/x.cpp", sentence + "int x = 1; // std::cos(angle)\n").empty());
  EXPECT_TRUE(violations("interp/geometry/x.cpp", call).empty());
  EXPECT_TRUE(violations("interp/evaluate/x.cpp", call).empty());
}

TEST(Layering, HeadersOutsideTheProjectThatCostOrBreakTooMuchAreSeen) {
  EXPECT_EQ(violations("formats/reports/x.h", sentence + "#include \"nlohmann/json.hpp\"\n").size(),
            1U);
  EXPECT_EQ(
      violations("formats/reports/x.cpp", sentence + "#include \"llvm/Support/JSON.h\"\n").size(),
      1U);
  EXPECT_EQ(violations("interp/x.cpp", sentence + "#include <fstream>\n").size(), 1U);
  EXPECT_EQ(violations("interp/x.cpp", sentence + "#include \"state.h\"\n").size(), 1U);
  EXPECT_TRUE(
      violations("formats/reports/x.cpp", sentence + "#include <nlohmann/json.hpp>\n").empty());
}

} // namespace
