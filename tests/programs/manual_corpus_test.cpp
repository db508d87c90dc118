// The programs that the manuals print are reported as the corpus beside the project says, when it
// is there. Each program is listed with all of its errors and warnings: more is as wrong as less.
#include "tests/support/places.h"
#include "tests/support/process.h"

#include "gtest/gtest.h"

#include <set>

namespace ncvet {
namespace {

/// What is asked of a program that is no more than a few lines is asked of those lines only: what
/// belongs to a whole program, and the set-up before them, counts as done.
const std::set<std::string> setUp = {"compensation-without-offset",
                                     "coordinate-work-offset-not-set",
                                     "feed-missing",
                                     "program-end-missing",
                                     "program-frame-missing",
                                     "spindle-off-while-cutting",
                                     "tool-missing"};

struct Printed {
  const char *file;
  const char *dialect;
  bool fragment;
  std::set<std::string> findings; ///< "line rule", errors and warnings
  const char *caller = nullptr;   ///< a program that says what this one is for
};

/// Shown by the test runner in place of the object's bytes.
void PrintTo(const Printed &printed, std::ostream *out) { *out << printed.file; }

std::string pathOf(const char *file) {
  return places::sourceFolder() + "/../shared/corpus/" + file;
}

/// The machine of the course from which the Sinumerik programs are.
constexpr const char *courseMachine = R"({
  "dialect": "sinumerik",
  "tools": { "1": {"kind": "endmill", "radius": 8}, "2": {"kind": "endmill", "radius": 5},
             "3": {"kind": "drill"} },
  "options": { "courseProfile": true }
})";

/// Those that are beside the project. The programs that a course wrote wrong on purpose (`BAD`) are
/// listed without what is advice by docs/severity.md: a block without a tool is one of the course's
/// mistakes, and what programs of machines with one tool look like.
std::vector<Printed> printedPrograms() {
  std::vector<Printed> list = {
      {"fanuc-nct/common-g52-local-pair.nc", "nct-104m", true, {}},
      {"fanuc-nct/common-g92-shift-pair.nc", "nct-104m", true, {}},
      {"fanuc-nct/fanuc0t-g77-stepped-shaft.nc", "fanuc-0t", false, {}},
      {"fanuc-nct/fanuc0t-g77-taper.nc", "fanuc-0t", false, {}},
      {"fanuc-nct/nct104m-O0001-M0001.nc",
       "nct-104m",
       false,
       {"3 motion-mode-not-set", "18 compensation-without-motion"}},
      {"fanuc-nct/nct104m-O0002-M0002.nc",
       "nct-104m",
       false,
       {"3 motion-mode-not-set", "7 syntax-incomplete-word", "7 feed-not-positive",
        "15 compensation-without-motion"}},
      {"fanuc-nct/nct104m-O0007-hole-patterns.nc",
       "nct-104m",
       false,
       {"3 motion-mode-not-set", "3 spindle-speed-missing"}},
      {"fanuc-nct/nct104m-O003-hole-patterns.nc", "nct-104m", false, {"3 motion-mode-not-set"}},
      {"fanuc-nct/nct104m-O9000-scaling-half-main.nc",
       "nct-104m",
       false,
       {"2 motion-mode-not-set"}},
      {"fanuc-nct/nct104m-O9001-scaling-up-main.nc", "nct-104m", false, {"2 motion-mode-not-set"}},
      {"fanuc-nct/nct104m-O9600-scaling-sub.nc", "nct-104m", false, {}},
      {"fanuc-nct/nct104m-O9887-mirror-main.nc", "nct-104m", false, {"2 motion-mode-not-set"}},
      {"fanuc-nct/nct104m-O9888-rotation-main.nc",
       "nct-104m",
       false,
       {"2 motion-mode-not-set", "5 coordinate-frame-left-on"}},
      {"fanuc-nct/nct104m-O9889-rotation-sub.nc", "nct-104m", false, {}},
      {"fanuc-nct/nct104m-O9900-mirror-sub.nc", "nct-104m", false, {}},
      {"fanuc-nct/nct104m-g16-polar-holes.nc", "nct-104m", true, {"1 block-modal-group-conflict"}},
      {"fanuc-nct/nct104m-g43-tool-call.nc", "nct-104m", true, {}},
      {"fanuc-nct/nct104t-O500-g73-pattern-repeat.nc",
       "nct-104t",
       false,
       {"6 syntax-decimal-comma", "8 syntax-decimal-comma"}},
      {"fanuc-nct/nct104t-O5001-L5001E.nc", "nct-104t", false, {"9 turning-start-inside-contour"}},
      {"fanuc-nct/nct104t-O5001-g78-thread.nc", "nct-104t", false, {}},
      {"fanuc-nct/nct104t-O5002-L5002E.nc",
       "nct-104t",
       false,
       {"9 turning-start-inside-contour", "21 syntax-code-in-comment"}},
      {"fanuc-nct/nct104t-O5004-L5004E.nc", "nct-104t", false, {"9 turning-start-inside-contour"}},
      {"fanuc-nct/nct104t-O5008-L5008E.nc", "nct-104t", false, {"9 turning-start-inside-contour"}},
      {"fanuc-nct/nct104t-O502-g74-face-groove.nc", "nct-104t", false, {"6 syntax-decimal-comma"}},
      {"fanuc-nct/nct104t-O503-g75-radial-groove.nc",
       "nct-104t",
       false,
       {"6 turning-two-block-form", "6 syntax-decimal-comma"}},
      {"fanuc-nct/nct104t-O504-g76-multi-thread.nc", "nct-104t", false, {}},
      {"fanuc-nct/nct104t-O807-2-L807-2-outer.nc",
       "nct-104t",
       false,
       {"10 turning-start-inside-contour", "40 cycle-left-active"}},
      {"fanuc-nct/nct104t-O8071-L807-1-inner.nc",
       "nct-104t",
       false,
       {"23 turning-start-inside-contour"}},
      {"fanuc-nct/nct104t-g71-rough.nc", "nct-104t", true, {"3 syntax-decimal-comma"}},
      {"fanuc-nct/nct104t-g77-stepped-shaft.nc", "nct-104t", false, {}},
      {"fanuc-nct/nct104t-g77-taper.nc", "nct-104t", false, {}},
      {"fanuc-nct/nct104t-g79-facing-disc.nc", "nct-104t", false, {}},
      {"fanuc-nct/nct104t-g79-facing-taper.nc", "nct-104t", false, {}},
      {"haas-lathe/angle-01-a110-x50.nc", "haas-lathe", true, {}},
      {"haas-lathe/angle-02-a110-zneg5.nc", "haas-lathe", true, {}},
      {"haas-lathe/angle-03-a190-x40.nc", "haas-lathe", true, {}},
      {"haas-lathe/angle-04-a190-zneg20.nc", "haas-lathe", true, {}},
      {"haas-lathe/angle-05-a190-x20.nc", "haas-lathe", true, {}},
      {"haas-lathe/angle-06-a190-zneg10.nc", "haas-lathe", true, {}},
      {"haas-lathe/angle-07-aneg100-x20.nc", "haas-lathe", true, {}},
      {"haas-lathe/angle-08-aneg100-zneg3.nc", "haas-lathe", true, {}},
      {"haas-lathe/comp-cancel-after-facing.nc", "haas-lathe", true, {"2 syntax-malformed-number"}},
      {"haas-lathe/comp-cancel-after-turning.nc",
       "haas-lathe",
       true,
       {"2 syntax-malformed-number"}},
      {"haas-lathe/comp-cancel-with-ik.nc", "haas-lathe", true, {"2 syntax-malformed-number"}},
      {"haas-lathe/corner-01-x40-r-neg.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-02-x40-k-neg.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-03-x40-r-pos.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-04-x40-k-pos.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-05-zneg30-r-pos.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-06-zneg30-i-pos.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-07-z30-r-pos.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-08-z30-i-pos.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-09-x20-r-neg.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-10-x20-k-neg.nc", "haas-lathe", true, {"2 syntax-missing-decimal-point"}},
      {"haas-lathe/corner-11-x20-r-pos.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-12-x20-k-pos.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-13-zneg40-r-neg.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-14-zneg40-i-neg.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-15-z40-r-neg.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-16-z40-i-neg.nc", "haas-lathe", true, {}},
      {"haas-lathe/corner-intro.nc", "haas-lathe", true, {}},
      {"haas-lathe/g32-chained-thread.nc", "haas-lathe", true, {"7 syntax-malformed-number"}},
      {"haas-lathe/g32-straight-thread-passes.nc",
       "haas-lathe",
       true,
       {"4 syntax-missing-decimal-point"}},
      {"haas-lathe/g70-finish-skeleton.nc",
       "haas-lathe",
       true,
       {"1 syntax-malformed-number", "2 syntax-malformed-number", "5 syntax-malformed-number",
        "6 syntax-malformed-number", "7 syntax-malformed-number", "9 syntax-malformed-number",
        "10 syntax-malformed-number", "11 syntax-malformed-number"}},
      {"haas-lathe/g71-type1-inside-schematic.nc",
       "haas-lathe",
       false,
       {"6 syntax-incomplete-word", "8 syntax-malformed-number", "9 syntax-malformed-number",
        "10 syntax-malformed-number", "11 syntax-malformed-number", "12 syntax-malformed-number",
        "13 syntax-malformed-number", "14 syntax-malformed-number", "15 syntax-malformed-number",
        "19 syntax-incomplete-word"}},
      {"haas-lathe/g71-type1-outside-o1234.nc", "haas-lathe", false, {}},
      {"haas-lathe/g71-type2-schematic.nc",
       "haas-lathe",
       false,
       {"6 syntax-incomplete-word", "8 syntax-malformed-number", "9 syntax-malformed-number",
        "10 syntax-malformed-number", "11 syntax-malformed-number", "12 syntax-malformed-number",
        "13 syntax-malformed-number", "14 syntax-malformed-number", "15 syntax-malformed-number",
        "19 syntax-incomplete-word"}},
      {"haas-lathe/g90-turning-passes.nc",
       "haas-lathe",
       false,
       {"1 coordinate-machine-move-suspicious", "3 spindle-css-without-clamp"}},
      {"haas-lathe/g92-thread-m30x3-5.nc",
       "haas-lathe",
       false,
       {"1 coordinate-machine-move-suspicious", "12 syntax-malformed-number"}},
      {"haas-lathe/o1-uebung.nc",
       "haas-lathe",
       false,
       {"17 syntax-missing-decimal-point", "25 program-end-missing"}},
      {"mefi/01-comment-own-block.ncp", "mefi", false, {}},
      {"mefi/02-generated-info-lines.ncp", "mefi", false, {"2 mefi-generated-block-broken"}},
      {"mefi/03-skeleton-priruba5612.ncp", "mefi", false, {}},
      {"mefi/04-generated-drill1-block.ncp", "mefi", false, {}},
      {"mefi/05-own-comment-wrong-place.ncp",
       "mefi",
       false,
       {"1 mefi-generated-block-broken", "1 cycle-never-executed"}},
      {"mefi/06-own-comment-right-place.ncp", "mefi", false, {"2 cycle-never-executed"}},
      {"mefi/07-own-comment-empty-block.ncp", "mefi", false, {"2 cycle-never-executed"}},
      {"mefi/08-technology-generated.ncp", "mefi", false, {}},
      {"mefi/09-technology-direct.ncp", "mefi", false, {}},
      {"mefi/10-three-holes-params-only.ncp", "mefi", false, {}},
      {"mefi/11-three-holes-with-drilling.ncp", "mefi", false, {}},
      {"mefi/12-m00-inside-cycle.ncp",
       "mefi",
       false,
       {"8 mefi-cycle-fires-on-empty-block", "2 syntax-invalid-character"}},
      {"mefi/13-g81.ncp", "mefi", false, {"1 syntax-invalid-character"}},
      {"mefi/14-g82.ncp", "mefi", false, {"1 syntax-invalid-character"}},
      {"mefi/15-g83.ncp", "mefi", false, {"1 syntax-invalid-character"}},
      {"mefi/16-g84.ncp", "mefi", false, {"1 syntax-invalid-character"}},
      {"mefi/17-g85.ncp", "mefi", false, {"1 syntax-invalid-character"}},
      {"mefi/18-g86.ncp", "mefi", false, {"1 syntax-invalid-character"}},
      {"mefi/19-g87-retract-out.ncp", "mefi", false, {"1 syntax-invalid-character"}},
      {"mefi/20-g87-retract-partial.ncp", "mefi", false, {"1 syntax-invalid-character"}},
      {"mefi/21-drill-test-g81-g87.ncp", "mefi", false, {}},
      {"mefi/d1-three-holes-extra-hole.ncp", "mefi", false, {}},
      {"mefi/d2-m00-fix-in-hole-block.ncp", "mefi", false, {"2 syntax-invalid-character"}},
      {"mefi/d3-m00-fix-cancel-and-recall.ncp", "mefi", false, {"2 syntax-invalid-character"}},
      {"mefi/d4-empty-block-inside-cycle.ncp",
       "mefi",
       false,
       {"8 mefi-cycle-fires-on-empty-block", "2 syntax-invalid-character"}},
      {"mefi/d5-grid-4x5.ncp", "mefi", false, {}},
      {"mefi/d6-grid-4x5-rotated-45.ncp", "mefi", false, {}},
      {"sinumerik/ARCHIV1.MPF", "sinumerik", false, {}},
      {"sinumerik/BAD71.MPF",
       "sinumerik",
       false,
       {"6 cycle-parameter-out-of-range", "7 cycle-parameter-out-of-range",
        "8 cycle-stepover-too-wide", "9 cycle-plunge-into-solid", "10 cycle-parameter-conflict",
        "11 cycle-parameter-out-of-range", "12 cycle-missing-parameter",
        "13 syntax-unbalanced-brackets"}},
      {"sinumerik/BAD72.MPF",
       "sinumerik",
       false,
       {"6 cycle-parameter-conflict", "6 cycle-parameter-out-of-range",
        "7 cycle-parameter-out-of-range", "7 flow-undefined-subprogram",
        "8 cycle-parameter-out-of-range", "9 cycle-missing-parameter",
        "10 flow-argument-mismatch"}},
      {"sinumerik/BADBLOK.MPF",
       "sinumerik",
       false,
       {"4 block-duplicate-address", "5 block-modal-group-conflict", "6 block-duplicate-address",
        "7 block-unknown-g-code", "8 syntax-assignment-sign", "9 block-missing-word",
        "10 block-must-stand-alone", "11 syntax-foreign-comment", "12 syntax-decimal-comma",
        "13 block-foreign-dialect-code", "14 block-foreign-dialect-code",
        "15 block-modal-group-conflict", "16 block-value-out-of-range",
        "17 syntax-invalid-character", "18 syntax-incomplete-word"}},
      {"sinumerik/BADFRAME.MPF",
       "sinumerik",
       false,
       {"7 coordinate-frame-replaced", "9 block-missing-word", "9 coordinate-frame-replaced",
        "13 arc-in-distorted-frame"}},
      {"sinumerik/BADKAPSA.MPF",
       "sinumerik",
       false,
       {"5 spindle-off-while-cutting", "7 cycle-parameter-out-of-range", "8 flow-argument-mismatch",
        "9 cycle-depth-order", "10 cycle-missing-parameter", "11 cycle-tool-does-not-fit",
        "12 cycle-tool-does-not-fit", "13 cycle-missing-parameter"}},
      {"sinumerik/BADKOR1.MPF",
       "sinumerik",
       false,
       {"9 compensation-forbidden-code", "12 compensation-idle-blocks",
        "14 compensation-with-cycle", "16 compensation-left-on", "17 spindle-speed-missing",
        "18 compensation-forbidden-code", "19 compensation-forbidden-code",
        "21 compensation-plane-change", "22 compensation-plane-change",
        "24 block-must-stand-alone"}},
      {"sinumerik/BADKOR2.MPF",
       "sinumerik",
       false,
       {"6 tool-offset-cancelled", "7 compensation-switched-on-arc",
        "7 compensation-without-offset", "12 compensation-left-on"}},
      {"sinumerik/BADKOR3.MPF",
       "sinumerik",
       false,
       {"7 compensation-entry-too-short", "9 compensation-radius-too-large"}},
      {"sinumerik/BADNAS.MPF",
       "sinumerik",
       false,
       {"3 tool-change-without-tool", "8 tool-not-changed", "9 block-value-out-of-range"}},
      {"sinumerik/BADOBL.MPF",
       "sinumerik",
       false,
       {"7 arc-radius-too-small", "8 arc-radius-mismatch", "9 arc-full-circle-with-radius",
        "10 arc-centre-missing", "11 arc-overdefined", "12 arc-wrong-centre-word",
        "13 block-value-out-of-range", "14 arc-special-form-invalid",
        "16 coordinate-polar-invalid"}},
      {"sinumerik/BADPOSUV.MPF",
       "sinumerik",
       false,
       {"4 feed-missing", "6 spindle-off-while-cutting", "8 feed-mode-change-without-feed",
        "11 spindle-off-while-cutting"}},
      {"sinumerik/BADPROM.MPF",
       "sinumerik",
       false,
       {"3 flow-argument-mismatch", "7 variable-index-out-of-range", "8 syntax-unknown-name",
        "9 variable-type-mismatch", "10 variable-domain-error"}},
      {"sinumerik/BADSUB.MPF",
       "sinumerik",
       false,
       {"6 flow-repeat-count", "7 flow-repeat-count", "9 block-must-stand-alone"}},
      {"sinumerik/BADTOK.MPF",
       "sinumerik",
       false,
       {"7 flow-undefined-target", "8 flow-undefined-target", "9 syntax-ambiguous-expression",
        "10 syntax-assignment-sign", "11 flow-constant-condition", "15 flow-structure-mismatch",
        "20 flow-duplicate-label", "21 flow-structure-mismatch"}},
      {"sinumerik/CELO71.MPF", "sinumerik", false, {}},
      {"sinumerik/FANUC1.MPF",
       "sinumerik",
       false,
       {"2 block-foreign-dialect-code", "2 syntax-foreign-comment", "3 block-foreign-dialect-code",
        "6 block-foreign-dialect-code", "7 block-foreign-dialect-code",
        "8 block-foreign-dialect-code", "9 block-foreign-dialect-code",
        "10 block-foreign-dialect-code", "11 block-foreign-dialect-code"}},
      {"sinumerik/IDIOMY.SPF", "sinumerik", false, {}},
      {"sinumerik/JEDNOTKY.MPF", "sinumerik", false, {"6 coordinate-unit-changed"}},
      {"sinumerik/KAPSA1.MPF", "sinumerik", false, {}},
      {"sinumerik/KAPSA2.MPF", "sinumerik", false, {}},
      {"sinumerik/KONT1.SPF", "sinumerik", false, {}},
      {"sinumerik/KONTBAD.SPF",
       "sinumerik",
       false,
       {"2 contour-profile-forbidden-code", "3 contour-profile-forbidden-code",
        "4 contour-profile-forbidden-code", "5 contour-profile-forbidden-code",
        "7 compensation-left-on", "7 flow-return-missing"},
       "sinumerik/BAD72.MPF"},
      {"sinumerik/KOREKCE1.MPF", "sinumerik", false, {}},
      {"sinumerik/L10.SPF", "sinumerik", false, {}},
      {"sinumerik/MILL1.SPF", "sinumerik", false, {}},
      {"sinumerik/NAJEZD1.MPF", "sinumerik", false, {}},
      {"sinumerik/OBDEL.SPF", "sinumerik", false, {}},
      {"sinumerik/OBLOUKY.MPF", "sinumerik", false, {}},
      {"sinumerik/OBRYS72.MPF", "sinumerik", false, {}},
      {"sinumerik/OPAK.MPF", "sinumerik", false, {}},
      {"sinumerik/POLAR.MPF", "sinumerik", false, {}},
      {"sinumerik/POSUNY.MPF", "sinumerik", false, {}},
      {"sinumerik/PROCHL.MPF", "sinumerik", false, {}},
      {"sinumerik/REKURZ.SPF", "sinumerik", false, {"3 flow-recursion"}},
      {"sinumerik/RMRIZ.MPF", "sinumerik", false, {}},
      {"sinumerik/SKOKY.MPF", "sinumerik", false, {}},
      {"sinumerik/SKOLA01.MPF", "sinumerik", false, {}},
      {"sinumerik/SOUCAST.MPF", "sinumerik", false, {}},
      {"sinumerik/STRUKT.MPF", "sinumerik", false, {}},
      {"sinumerik/SUBKON.SPF", "sinumerik", false, {}},
      {"sinumerik/VRTANI.MPF", "sinumerik", false, {}},
      {"sinumerik/ZAOBL.MPF", "sinumerik", false, {}},
  };
  llvm::erase_if(list, [](const Printed &p) { return !std::filesystem::exists(pathOf(p.file)); });
  return list;
}

TEST(ManualPrograms, LieBesideTheProject) {
  if (printedPrograms().empty())
    GTEST_SKIP() << "the manuals' programs are not beside the project: they are not compared";
}

class ManualProgram : public testing::TestWithParam<Printed> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ManualProgram);

TEST_P(ManualProgram, IsReportedAsTheManualHasIt) {
  const Printed &printed = GetParam();
  test::Shop shop;
  std::vector<std::string> arguments = {
      "check", "--dialect", printed.dialect, "--format",
      "json",  "--fail-on", "never",         pathOf(printed.file)};
  if (printed.caller)
    arguments.push_back(pathOf(printed.caller));
  if (printed.dialect == llvm::StringRef("sinumerik")) {
    shop.file("machine.json", courseMachine);
    arguments.insert(arguments.end(), {"--machine", "machine.json"});
  }
  const test::ProcessResult result = shop.run(arguments);
  const auto json = nlohmann::json::parse(result.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << result.err;
  std::set<std::string> found;
  for (const auto &finding : json["findings"]) {
    const std::string rule = finding["rule"];
    // What is found in a program that it calls is that program's.
    const bool here = llvm::StringRef(finding["path"].get<std::string>()).endswith(printed.file);
    if (here && finding["severity"] != "style" && !(printed.fragment && setUp.count(rule)))
      found.insert(std::to_string(finding["line"].get<int>()) + " " + rule);
  }
  EXPECT_EQ(printed.findings, found);
}

INSTANTIATE_TEST_SUITE_P(Corpus, ManualProgram, testing::ValuesIn(printedPrograms()),
                         [](const testing::TestParamInfo<Printed> &info) {
                           std::string name = info.param.file;
                           for (char &c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c)))
                               c = '_';
                           return name;
                         });

} // namespace
} // namespace ncvet
