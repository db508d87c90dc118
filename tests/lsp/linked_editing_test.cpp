// Places that are typed together: numbers of loops, labels of brackets.
#include "lsp/features/writing/linked_editing.h"
#include "tests/support/marked_text.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;

/// The program with the places in braces that change with the one at `mark`.
std::string linked(llvm::StringRef dialect, llvm::StringRef program, llvm::StringRef mark) {
  const auto text = test::markedText(dialect, program);
  const size_t offset = text->text().find(mark);
  EXPECT_NE(offset, std::string::npos) << mark.str();
  std::string out;
  uint32_t at = 0;
  for (const SourceRange &place : lsp::linkedPlaces(*text, uint32_t(offset + mark.size()))) {
    out += text->text().slice(at, place.begin).str() + "{" +
           text->text().slice(place.begin, place.end).str() + "}";
    at = place.end;
  }
  return out + text->text().drop_front(at).str();
}

TEST(LinkedEditing, TheNumbersOfALoop) {
  const char *const program = "O1\nWHILE[#1LT5]DO1\nWHILE[#2LT5]DO2\n#2=#2+1\nEND2\n#1=#1+1\nEND1\n"
                              "WHILE[#3LT5]DO1\n#3=#3+1\nEND1\nM30\n";
  EXPECT_EQ(linked("fanuc-mill", program, "#2LT5]DO"),
            "O1\nWHILE[#1LT5]DO1\nWHILE[#2LT5]DO{2}\n#2=#2+1\nEND{2}\n#1=#1+1\nEND1\n"
            "WHILE[#3LT5]DO1\n#3=#3+1\nEND1\nM30\n");
  EXPECT_EQ(linked("fanuc-mill", program, "#3=#3+1\nEND1"),
            "O1\nWHILE[#1LT5]DO1\nWHILE[#2LT5]DO2\n#2=#2+1\nEND2\n#1=#1+1\nEND1\n"
            "WHILE[#3LT5]DO{1}\n#3=#3+1\nEND{1}\nM30\n")
      << "the loop before it has the same number, and is another one";
  EXPECT_EQ(linked("fanuc-mill", program, "WHI"), program) << "the condition belongs to nothing";
}

TEST(LinkedEditing, TheLabelOfBrackets) {
  EXPECT_EQ(linked("linuxcnc", "o100 while [#1 lt 5]\n#1=[#1+1]\no100 endwhile\nM2\n", "o1"),
            "o{100} while [#1 lt 5]\n#1=[#1+1]\no{100} endwhile\nM2\n");
  EXPECT_EQ(
      linked("linuxcnc", "o<hole> sub\nG1 X1 F100\no<hole> endsub\no<hole> call\nM2\n", "o<h"),
      "o<{hole}> sub\nG1 X1 F100\no<{hole}> endsub\no<{hole}> call\nM2\n");
}

TEST(LinkedEditing, NothingWhereNothingBelongsTogether) {
  const char *const program = "O1\nN10 G00 X1.\nGOTO 10\nM30\n";
  EXPECT_EQ(linked("fanuc-mill", program, "X"), program);
  EXPECT_EQ(linked("fanuc-mill", program, "N1"), program) << "a target is renamed, with all jumps";
}

} // namespace
