// Straight-line code is followed without a piece of memory for each block.
#include "tests/support/run_program.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<uint64_t> allocations{0};

void *counted(std::size_t size) {
  ++allocations;
  if (void *const memory = std::malloc(size ? size : 1))
    return memory;
  std::abort();
}
} // namespace

void *operator new(std::size_t size) { return counted(size); }
void *operator new[](std::size_t size) { return counted(size); }
void operator delete(void *memory) noexcept { std::free(memory); }
void operator delete[](void *memory) noexcept { std::free(memory); }
void operator delete(void *memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void *memory, std::size_t) noexcept { std::free(memory); }

namespace ncvet::test {
namespace {

struct Kind {
  const char *name, *dialect, *head, *tail;
  std::string (*block)(unsigned);
};

void PrintTo(const Kind &kind, std::ostream *out) { *out << kind.name; }

std::string place(unsigned i, const char *first, const char *second) {
  return std::string(first) + std::to_string(i % 90) + "." + std::to_string(100 + i % 800) +
         second + std::to_string(i * 7 % 60) + "." + std::to_string(100 + i % 700);
}

constexpr const char *mill = "%\nO1000\nG21 G17 G90 G94 G40 G49 G80\nT1 M6\nG54 S1000 M3\n"
                             "G0 X0. Y0.\nG43 H1 Z5.\nG1 Z-1. F200.\n";
constexpr const char *millEnd = "G80\nG0 Z50.\nM5\nG49\nM30\n%\n";

const Kind kinds[] = {
    {"Surfacing", "fanuc-0m", mill, millEnd, [](unsigned i) { return place(i, "X", " Y") + "\n"; }},
    {"SurfacingWithNumbersAndCodes", "haas-mill", mill, millEnd,
     [](unsigned i) { return "N" + std::to_string(i + 100) + place(i, " G1 X", " Y") + "\n"; }},
    {"SurfacingOnASinumerik", "sinumerik", "G17 G54 G71 G90 G94\nT1 M6\nD1\nS900 M3\nG1 Z-1 F99\n",
     "M30\n", [](unsigned i) { return place(i, "X", " Y") + "\n"; }},
    {"CommentsAndBlankLines", "fanuc-0m", mill, millEnd,
     [](unsigned i) {
       return i % 3 ? std::string("(WHAT COMES NEXT)\n\n") : place(i, "X", " Y") + "\n";
     }},
    {"ContoursOfArcs", "fanuc-0m", mill, millEnd,
     [](unsigned i) {
       // A wave of half circles, to and fro.
       const unsigned at = (i / 100 % 2 ? 100 - i % 100 : i % 100 + 1) * 5;
       return (i % 2 ? "G2 X" : "G3 X") + std::to_string(at) + ". Y0. R2.5\n";
     }},
    {"DrillingCycles", "fanuc-0m", mill, millEnd,
     [](unsigned i) {
       return i % 40 ? place(i, "X", " Y") + "\n"
                     : (i % 80 ? "G98 G81" : "G99 G83 Q3.") + place(i, " X", " Y") +
                           " Z-9. R2. F180.\n";
     }},
    {"Turning", "fanuc-0t", "%\nO1000\nG21 G99 G40\nG50 S3000\nT0101\nG96 S200 M03\nG00 X90. Z5.\n",
     "G00 X120.\nG28 U0. W0.\nM05\nM30\n%\n",
     [](unsigned i) {
       const char *const pass[] = {
           "G00 X40. Z2.\n",       "G01 Z0. F0.25\n",  "G03 X44. Z-2. R2.\n", "G01 Z-18.\n",
           "G02 X50. Z-21. R3.\n", "G01 X60. Z-40.\n", "G00 X90.\n",          "Z2.\n"};
       return std::string(pass[i % 8]);
     }},
    {"LongLines", "haas-mill", mill, millEnd,
     [](unsigned i) {
       return place(i, "G90 G94 G17 G21 G40 G54 G64 G1 X", " Y") + " F2400. S1200 M3 (POINT)\n";
     }},
    {"SurfacingWithRetracts", "fanuc-0m", mill, millEnd,
     [](unsigned i) {
       return i % 50 == 0   ? std::string("G0 Z5.\n")
              : i % 50 == 1 ? std::string("G1 Z-2. F300.\n")
                            : place(i, "X", " Y") + "\n";
     }},
};

uint64_t allocationsFor(const Kind &kind, unsigned blocks) {
  std::string text = kind.head;
  for (unsigned i = 0; i < blocks; ++i)
    text += kind.block(i);
  text += kind.tail;
  uint64_t count = 0;
  withProgram(kind.dialect, {{"part.nc", text}}, "", [&](Project &project, FileUnit &unit) {
    const RuleSelection rules = RuleSelection::defaults(*unit.dialect);
    EXPECT_EQ(rules.enabled.size(), allRules().size());
    const uint64_t before = allocations;
    analyze(project, unit, rules);
    count = allocations - before;
  });
  return count;
}

class AllocationTest : public testing::TestWithParam<Kind> {};

TEST_P(AllocationTest, ALongerProgramAllocatesNoMore) {
  constexpr unsigned blocks = 3000;
  const uint64_t some = allocationsFor(GetParam(), blocks);
  const uint64_t twice = allocationsFor(GetParam(), 2 * blocks);
  // Lists that grow by doubling grow a few times more.
  constexpr uint64_t growth = 100;
  EXPECT_LE(twice, some + growth) << some << " for " << blocks << " blocks";
}

INSTANTIATE_TEST_SUITE_P(Kinds, AllocationTest, testing::ValuesIn(kinds),
                         [](const auto &info) { return std::string(info.param.name); });

} // namespace
} // namespace ncvet::test
