// Signature help: the parameters of what is being written, and the active one.
#include "lsp/features/writing/signature_help.h"
#include "tests/support/marked_text.h"

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using testing::HasSubstr;

/// The label with the active parameter in stars; empty: no signature.
std::string signatureAt(llvm::StringRef dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  const auto signature = lsp::signatureHelp(*text, text.marks[0]);
  if (!signature)
    return {};
  if (signature->active < 0)
    return signature->label;
  const auto &active = signature->parameters[size_t(signature->active)];
  const llvm::StringRef label = signature->label;
  return (label.take_front(active.begin) + "*" + label.slice(active.begin, active.end) + "*" +
          label.drop_front(active.end))
      .str();
}

TEST(SignatureHelp, ArgumentsOfACycle) {
  EXPECT_EQ(signatureAt("sinumerik", "CYCLE81(10,0,<|>)\n"),
            "CYCLE81(RTP, RFP, *SDIS*, DP, DPR, DTB)");
  EXPECT_EQ(signatureAt("sinumerik", "CYCLE81(<|>"), "CYCLE81(*RTP*, RFP, SDIS, DP, DPR, DTB)");
  EXPECT_EQ(signatureAt("sinumerik", "CYCLE81(R1*(2+3),<|>"),
            "CYCLE81(RTP, *RFP*, SDIS, DP, DPR, DTB)");
}

TEST(SignatureHelp, ParametersOfAProgram) {
  EXPECT_EQ(signatureAt("sinumerik", "%_N_MAIN_MPF\nPART(1,<|>)\nM30\n%_N_PART_SPF\nPROC "
                                     "PART(REAL A, INT B)\nRET\n"),
            "PART(A, *B*)");
}

TEST(SignatureHelp, WordsOfACycle) {
  const std::string signature = signatureAt("fanuc-0m", "O1\nG83 Z-5. Q1<|>\nM30\n");
  EXPECT_THAT(signature, HasSubstr("G83 "));
  EXPECT_THAT(signature, HasSubstr("*Q*"));
  EXPECT_THAT(signature, HasSubstr("Z"));
}

TEST(SignatureHelp, ArgumentsOfAMacro) {
  const std::string signature = signatureAt("fanuc-0m", "O1\nG65 P9010 A<|>1.\nM30\n");
  EXPECT_THAT(signature, HasSubstr("G65 P L *A* B C"));
}

TEST(SignatureHelp, NoneOutsideOfCallsAndInComments) {
  EXPECT_EQ(signatureAt("haas-mill", "O1\nX1. <|>\n"), "");
  EXPECT_EQ(signatureAt("sinumerik", "G0 X1 ; CYCLE81(<|>\n"), "");
  EXPECT_EQ(signatureAt("sinumerik", "R1=(<|>\n"), "");
}

TEST(SignatureHelp, NoPlaceOfABrokenProgramBreaksIt) {
  const llvm::StringRef broken = "N10 G1 X= Y[ #[ IF[ <MIR:; CYCLE81(,,\nG65 P ((\n%\nGOTO\n\"";
  for (const char *dialect : {"haas-lathe", "fanuc-0m", "sinumerik", "ecs", "mefi", "linuxcnc"}) {
    const auto text = test::markedText(dialect, broken);
    for (uint32_t at = 0; at <= broken.size(); ++at)
      lsp::signatureHelp(*text, at);
  }
}

} // namespace
