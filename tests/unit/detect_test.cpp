// Detection of the dialect, and of what is a program at all.
#include "analyzer/detect.h"

#include <gtest/gtest.h>

#include <chrono>

namespace ncvet {
namespace {

const Detector &detector() {
  static const Detector *const made = [] {
    auto detector = Detector::create();
    if (!detector) {
      ADD_FAILURE() << llvm::toString(detector.takeError());
      std::abort();
    }
    return new Detector(std::move(*detector));
  }();
  return *made;
}

const char *const mill =
    "%\nO1001 (COVER)\nN10 G21 G17 G40 G49 G80 G90\nN20 T1 M6\nN30 S2000 M3\n"
    "N40 G54 G0 X0. Y0.\nN50 G43 H1 Z50. M8\nN60 G81 X10. Y10. Z-5. R2. F100.\n"
    "N70 G80\nN80 G91 G28 Z0.\nN90 M30\n%\n";

TEST(Detection, SaysWhatSpokeForTheDialect) {
  const Detection found = detector().detect("cover.nc", mill);
  EXPECT_FALSE(found.dialect.empty());
  EXPECT_FALSE(found.reason.empty());
}

TEST(Detection, TextThatSaysNothingIsReadAsTheUsualControl) {
  const Detection empty = detector().detect("x", "");
  const Detection plain = detector().detect("x", "G0 X0\nG1 X1\n");
  EXPECT_EQ(empty.dialect, plain.dialect);
  EXPECT_NE("", empty.dialect);
}

TEST(Detection, DoesNotDependOnCaseOrLineEnds) {
  std::string crlf;
  for (const char c : llvm::StringRef(mill).lower()) {
    if (c == '\n')
      crlf += '\r';
    crlf += c;
  }
  EXPECT_EQ(detector().detect("a.nc", mill).dialect, detector().detect("a.nc", crlf).dialect);
}

TEST(Detection, TakesLittleTimeForAnyText) {
  std::string text;
  while (text.size() < 1u << 20)
    text += "N100 G01 X12.345 Y-67.89 Z1.5 F1200. (FINISH)\n";
  detector().detect("a.nc", text);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 10; ++i)
    detector().detect("a.nc", text);
  const auto each = (std::chrono::steady_clock::now() - begin) / 10;
  // The aim is a millisecond; a loaded machine and sanitizers get room.
  EXPECT_LT(each, std::chrono::milliseconds(500));
}

TEST(Detection, AnyBytesGiveAnAnswer) {
  std::string bytes;
  for (int i = 0; i < 512; ++i)
    bytes.push_back(char(i));
  EXPECT_NE("", detector().detect(bytes, bytes).dialect);
}

TEST(LooksLikeProgram, BlocksDoAndProseDoesNot) {
  EXPECT_TRUE(looksLikeProgram(mill));
  EXPECT_TRUE(looksLikeProgram("g0 x0 y0\ng1 z-1. f100\n/m30\n"));
  EXPECT_TRUE(looksLikeProgram("#1=10\nG1 X#1\nM99\n"));
  EXPECT_FALSE(looksLikeProgram(""));
  EXPECT_FALSE(looksLikeProgram("Tool list for cover\nT1 face mill 50 mm\nT2 drill\nT3 tap\n"));
  EXPECT_FALSE(looksLikeProgram("10;20;30\n40;50;60\n"));
  EXPECT_FALSE(looksLikeProgram("{ \"a\": 1 }\n"));
}

} // namespace
} // namespace ncvet
