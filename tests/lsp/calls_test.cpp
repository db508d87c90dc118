// Calls: the hierarchy of programs, and links into other files.
#include "lsp/features/navigation/call_hierarchy.h"
#include "lsp/features/navigation/links.h"
#include "tests/support/marked_text.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"

#include <fstream>

namespace {

using namespace ncvet;
using namespace ncvet::lsp;
using Lines = std::vector<std::string>;

/// "O2 | SUB: 2 3" for each edge: the item, and the lines of its calls.
Lines describe(Snapshot &snapshot, const std::vector<CallEdge> &edges) {
  Lines lines;
  for (const CallEdge &edge : edges) {
    std::string line = edge.item.name + (edge.item.detail.empty() ? "" : " | " + edge.item.detail);
    line += ":";
    for (const SourceRange &place : edge.places)
      line += " " + std::to_string(
                        snapshot.project().sources().get(place.file).position(place.begin).line);
    lines.push_back(line);
  }
  return lines;
}

struct Item {
  std::string name;
  Lines outgoing, incoming;
};

Item itemAt(const test::MarkedText &text, const std::vector<std::string> &paths = {}) {
  const auto item = callItem(*text, text.marks[0]);
  if (!item)
    return {};
  const SourceFile &file = text->project().sources().get(item->selection.file);
  EXPECT_LE(item->full.begin, item->selection.begin);
  EXPECT_LE(item->selection.end, item->full.end);
  return {item->name, describe(*text, outgoingCalls(*text, file.path(), item->selection.begin)),
          describe(*text, incomingCalls(*text, file.path(), item->selection.begin, paths))};
}

TEST(CallHierarchy, OfProgramsInOneFile) {
  const Item item = itemAt(test::markedText("fanuc-0m", "O1\nM98 P2\nM30\nO0002 (SUB)\nG0<|> X1.\n"
                                                        "M98 P3\nG65 P3 A1.\nM98 P4\nM99\n"
                                                        "O3\nM99\nO5\nM98 P2\nM98 P2\nM99\n"));
  EXPECT_EQ(item.name, "O0002");
  EXPECT_EQ(item.outgoing, (Lines{"O3: 6 7"}));
  EXPECT_EQ(item.incoming, (Lines{"O1: 2", "O5: 13 14"}));
}

TEST(CallHierarchy, OfLocalCalls) {
  const Item item = itemAt(test::markedText("haas-lathe", "O1\nM97 P1<|>00\nM97 P200\nM30\n"
                                                          "N100 (A)\nM97 P200\nM99\nN200\nM99\n"));
  EXPECT_EQ(item.name, "N100");
  EXPECT_EQ(item.outgoing, (Lines{"N200: 6"}));
  EXPECT_EQ(item.incoming, (Lines{"O1: 2"}));
}

TEST(CallHierarchy, OfSubprogramsBetweenBrackets) {
  const Item item =
      itemAt(test::markedText("linuxcnc", "o<a> sub\no<b> call\no<a> endsub\n"
                                          "o<b> sub\no<b> endsub\no<<|>a> call\nM2\n"));
  EXPECT_EQ(item.name, "a");
  EXPECT_EQ(item.outgoing, (Lines{"b: 2"}));
  EXPECT_EQ(item.incoming, (Lines{"program: 6"}));
}

TEST(CallHierarchy, AcrossFiles) {
  const test::TemporaryFolder folder;
  const auto write = [&](const char *name, const char *text) {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
    return (folder.path() / name).string();
  };
  const std::vector<std::string> paths = {write("HOLE.SPF", "PROC HOLE\nDRILL\nM17\n"),
                                          write("DRILL.SPF", "M17\n"),
                                          write("OTHER.MPF", "G0\nHOLE\nM30\n")};
  const auto text = test::markedText("sinumerik", "HO<|>LE\nDRILL\nMCALL DRILL\nM30\n",
                                     (folder.path() / "MAIN.MPF").string());
  const Item item = itemAt(text, paths);
  EXPECT_EQ(item.name, "HOLE");
  EXPECT_EQ(item.outgoing, (Lines{"DRILL: 2"}));
  EXPECT_EQ(item.incoming, (Lines{"MAIN: 1", "OTHER: 2"}));

  std::vector<std::string> leads;
  for (const Link &link : links(*text))
    leads.push_back(text->text().slice(link.range.begin, link.range.end).str() + " " +
                    std::filesystem::path(link.path).filename().string());
  EXPECT_EQ(leads, (Lines{"HOLE HOLE.SPF", "DRILL DRILL.SPF", "DRILL DRILL.SPF"}));
}

TEST(Links, LeadIntoOtherFilesOnly) {
  const auto text = test::markedText("fanuc-0m", "O1\nM98 P2\nM98 P77\nM30\nO2\nM99\n");
  EXPECT_TRUE(links(*text).empty());
}

} // namespace
