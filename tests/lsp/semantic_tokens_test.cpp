// Semantic tokens: every control's words are named, in order and never over each other.
#include "lsp/features/showing/semantic_tokens.h"
#include "tests/support/marked_text.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using lsp::SemanticToken;

/// `function:G01 property:X number:10`; definitions with `!`, unknown ones with `?`.
std::string tokensOf(llvm::StringRef dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  std::string out;
  uint32_t last = 0;
  for (const SemanticToken &token : lsp::semanticTokens(*text)) {
    EXPECT_GE(token.begin, last);
    EXPECT_LT(token.begin, token.end);
    last = token.end;
    const llvm::StringRef spelled = text->text().slice(token.begin, token.end);
    EXPECT_TRUE(!spelled.contains('\n') && !spelled.contains('\r'));
    out += (out.empty() ? "" : " ") + lsp::tokenTypeNames()[size_t(token.type)].str() +
           (token.modifiers & lsp::tokenDefinition ? "!" : "") +
           (token.modifiers & lsp::tokenUnknown ? "?" : "") + ":" + spelled.str();
  }
  return out;
}

TEST(SemanticTokens, WordsOfALathe) {
  EXPECT_EQ(tokensOf("haas-lathe", "O1 (PART)\n/N10 G01 X10. F.2 M08\nG71 P10 Q20\n"),
            "class!:O1 comment:(PART) operator:/ label!:N10 function:G01 property:X number:10. "
            "parameter:F number:.2 macro:M08 function:G71 parameter:P label:10 parameter:Q "
            "label:20");
}

TEST(SemanticTokens, MacrosOfAMill) {
  EXPECT_EQ(tokensOf("fanuc-0m", "#100=SIN[30.]\nIF[#100EQ10]GOTO20\nG65 P9010 A-1.\nX[#100+1.]\n"),
            "variable:#100 operator:= method:SIN number:30. keyword:IF variable:#100 operator:EQ "
            "number:10 keyword:GOTO label:20 function:G65 parameter:P class:9010 property:A "
            "number:-1. property:X variable:#100 operator:+ number:1.");
}

TEST(SemanticTokens, TheLanguageOfSinumerik) {
  EXPECT_EQ(tokensOf("sinumerik", "DEF REAL DEPTH=5\nMARK1: G1 X=DEPTH+R1 CR=2\nIF R1==2 GOTOF "
                                  "MARK1\nCYCLE81(10,0,2,-8)\nMSG(\"go\") ; text\nTRANS X5\n"),
            "keyword:DEF type:REAL variable!:DEPTH operator:= number:5 label!:MARK1 function:G1 "
            "property:X operator:= variable:DEPTH operator:+ variable:R1 parameter:CR operator:= "
            "number:2 keyword:IF variable:R1 operator:== number:2 keyword:GOTOF label:MARK1 "
            "function:CYCLE81 number:10 number:0 number:2 number:-8 function:MSG string:\"go\" "
            "comment:; text function:TRANS property:X number:5");
}

TEST(SemanticTokens, TheInstructionsOfEcs) {
  EXPECT_EQ(tokensOf("ecs", "N10 G81 X5 <ENT=-10>\n<MIR:ON; X>\nDX5\n<JMP: N10>\n"),
            "label!:N10 function:G81 property:X number:5 operator:< variable:ENT operator:= "
            "number:-10 operator:> operator:< function:MIR enumMember:ON enumMember:X operator:> "
            "property:DX number:5 operator:< keyword:JMP label:N10 operator:>");
}

TEST(SemanticTokens, BlocksOfManyLines) {
  EXPECT_EQ(tokensOf("mefi", "N10 G0 X10\n  Z5\nN20 R30=2 M30\n"),
            "label!:N10 function:G0 property:X number:10 property:Z number:5 label!:N20 "
            "variable:R30 operator:= number:2 macro:M30");
}

TEST(SemanticTokens, TheWordsOfLinuxCnc) {
  EXPECT_EQ(tokensOf("linuxcnc", "o<sub1> sub\n#<depth> = [#1 * -2]\nG1 X#<depth> (debug)\n"
                                 "o<sub1> endsub\no<sub1> call [2]\n"),
            "class!:o<sub1> keyword:sub variable:#<depth> operator:= variable:#1 operator:* "
            "operator:- number:2 function:G1 property:X variable:#<depth> comment:(debug) "
            "label:o<sub1> keyword:endsub class:o<sub1> keyword:call number:2");
}

TEST(SemanticTokens, WhatNoControlKnowsIsMarked) {
  EXPECT_EQ(tokensOf("haas-mill", "G999 X1\n"), "function?:G999 property:X number:1");
}

TEST(SemanticTokens, ARangeGivesTheTokensThatTouchIt) {
  const auto text = test::markedText("haas-mill", "G00 X1.\nG01 <|>Y2.<|> F3.\nM30\n");
  const auto tokens = lsp::semanticTokens(*text, text.marks[0], text.marks[1]);
  ASSERT_EQ(tokens.size(), 2u);
  EXPECT_EQ(text->text().slice(tokens[0].begin, tokens[1].end), "Y2.");
}

TEST(SemanticTokens, ALineAsLongAsTheFileIsReadOnce) {
  std::string program = "#1=[";
  for (int i = 0; i < 100000; ++i)
    program += "#2+";
  const auto text = test::markedText("fanuc-0m", program + "1]\n");
  EXPECT_EQ(lsp::semanticTokens(*text).size(), 200003u);
}

TEST(SemanticTokens, AnyBytesAreTokenised) {
  std::string noise;
  uint32_t seed = 1;
  constexpr llvm::StringLiteral alphabet = "GMXN019.-+#<>[](){}\"';:=,%/\n\r\t $abcIFDEF\xC3\xBC";
  for (int i = 0; i < 4000; ++i) {
    seed = seed * 1664525 + 1013904223;
    noise += alphabet[(seed >> 16) % alphabet.size()];
  }
  for (const char *dialect : {"haas-lathe", "fanuc-0m", "sinumerik", "ecs", "mefi", "linuxcnc"})
    tokensOf(dialect, noise);
}

} // namespace
