// Tables: merging, variants, conditions, errors with their lines, machine profiles, built-in files.
#include "formats/dialect/code_name.h"
#include "formats/dialect/control_facts.h"
#include "formats/dialect/json_place.h"
#include "formats/dialect/loader.h"

#include "llvm/Support/Regex.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

namespace ncvet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

using Files = std::map<std::string, std::string>;

DialectSource sourceOf(const Files &files) {
  return [&files](llvm::StringRef id) -> std::optional<std::pair<std::string, llvm::StringRef>> {
    auto found = files.find(id.str());
    if (found == files.end())
      return std::nullopt;
    return std::pair(id.str() + ".json", llvm::StringRef(found->second));
  };
}

std::shared_ptr<const Dialect> load(const Files &files, const std::string &id) {
  auto dialect = loadDialect(id, sourceOf(files));
  if (dialect)
    return *dialect;
  ADD_FAILURE() << llvm::toString(dialect.takeError());
  return nullptr;
}

std::string errorOf(const Files &files, const std::string &id) {
  auto dialect = loadDialect(id, sourceOf(files));
  if (!dialect)
    return llvm::toString(dialect.takeError());
  return "";
}

std::string profileError(const std::string &text) {
  auto profile = parseMachineProfile("machine.json", text);
  if (!profile)
    return llvm::toString(profile.takeError());
  return "";
}

std::shared_ptr<const Dialect> builtin(llvm::StringRef id) {
  auto dialect = loadDialect(id, builtinDialects());
  if (dialect)
    return *dialect;
  ADD_FAILURE() << llvm::toString(dialect.takeError());
  return nullptr;
}

/// A small lathe table; `codes` is on the line after this head, which is line 9.
std::string table(const std::string &codes, const std::string &more = "") {
  return R"({ "id": "t", "title": "test", "reader": "iso", "machine": "lathe",
  "addresses": { "X": { "kind": "axis", "axis": "X", "unit": "length" },
                 "Z": { "kind": "axis", "axis": "Z", "unit": "length" },
                 "U": { "kind": "increment", "axis": "X" }, "P": { "kind": "parameter" } },
  "groups": { "motion": {}, "cycle": { "initial": "G80" } },
  "options": { "liveTools": null, "model": "A" },
  "switches": { "coolant": { "off": "M09" }, "shift": {} },
  "codes": {
)" + codes +
         "\n}" + more + "}";
}

const std::string plain = R"("G00": { "group": "motion", "does": "rapid", "takes": "XZ" },
"G80": { "group": "cycle", "does": "cycle-cancel" })";

TEST(DialectLoader, ACodeIsFoundByNumberAndByBothSpellings) {
  Files files{{"t", table(plain + R"(, "G84.2": { "title": "rigid" }, "M03": {})")}};
  auto dialect = load(files, "t");
  ASSERT_TRUE(dialect);
  EXPECT_EQ(dialect->codes[dialect->find('G', 842)].title, "rigid");
  EXPECT_EQ(dialect->find("G0"), dialect->find("G00"));
  EXPECT_EQ(dialect->codes[dialect->find("M3")].name, "M03");
  EXPECT_EQ(dialect->find('M', 31), noCode);
  EXPECT_EQ(dialect->find('G', 99990), noCode);
  EXPECT_EQ(dialect->find("G84"), noCode);
}

TEST(DialectLoader, GroupsHaveMembersBitsAndInitialStates) {
  Files files{{"t", table(plain + R"(, "G01": { "group": "motion" })")}};
  auto dialect = load(files, "t");
  ASSERT_TRUE(dialect);
  const GroupInfo &motion = dialect->groups[dialect->group(StandardGroup::Motion)];
  EXPECT_THAT(motion.members, ElementsAre(dialect->find("G00"), dialect->find("G01")));
  EXPECT_EQ(motion.initial, 0xFF);
  EXPECT_EQ(dialect->codes[dialect->find("G01")].bit, 1);
  EXPECT_EQ(dialect->groups[dialect->group(StandardGroup::Cycle)].initial, 0);
  EXPECT_EQ(dialect->group(StandardGroup::Plane), noGroup);
}

TEST(DialectLoader, AnExtendingTableMergesByKeyAndNullTakesAway) {
  Files files{{"t", table(plain)}, {"top", R"({ "id": "top", "title": "top", "extends": "t",
                "addresses": { "P": null, "Z": { "title": "bed" } },
                "codes": { "G80": null, "G00": { "title": "fast" }, "G01": { "group": "motion" } },
                "groups": { "cycle": { "initial": null } } })"}};
  auto dialect = load(files, "top");
  ASSERT_TRUE(dialect);
  EXPECT_EQ(dialect->title, "top");
  EXPECT_EQ(dialect->find("G80"), noCode);
  EXPECT_EQ(dialect->codes[dialect->find("G00")].title, "fast");
  EXPECT_EQ(dialect->codes[dialect->find("G00")].action, Action::Rapid);
  EXPECT_NE(dialect->find("G01"), noCode);
  EXPECT_EQ(dialect->known & maskOf('P'), 0u);
  EXPECT_EQ(dialect->addresses[letterAddress('Z')].title, "bed");
  EXPECT_EQ(dialect->addresses[letterAddress('Z')].axis, Axis::Z);
}

TEST(DialectLoader, AVariantIsItsCodeWithItsOwnKeysLaidOver) {
  Files files{{"t", table(plain + R"(, "G83": { "title": "peck", "group": "cycle", "does": "cycle",
    "words": { "Z": { "need": "first" }, "P": { "role": "peck" } },
    "variants": [ { "when": { "any": "X" }, "title": "degressive",
                    "words": { "P": null, "X": { "role": "peck-first" } } } ] })")}};
  auto dialect = load(files, "t");
  ASSERT_TRUE(dialect);
  const CodeInfo &base = dialect->codes[dialect->find("G83")];
  ASSERT_EQ(base.variants.size(), 1u);
  EXPECT_EQ(base.variants[0].when.any, maskOf('X'));
  const CodeInfo &variant = dialect->codes[base.variants[0].code];
  EXPECT_EQ(variant.name, "G83");
  EXPECT_EQ(variant.title, "degressive");
  EXPECT_EQ(variant.group, base.group);
  EXPECT_EQ(variant.bit, base.bit);
  EXPECT_EQ(variant.base, dialect->find("G83"));
  EXPECT_EQ(variant.action, Action::Cycle);
  EXPECT_EQ(variant.takes, lettersMask("XZ"));
  EXPECT_EQ(base.takes, lettersMask("ZP"));
  EXPECT_EQ(dialect->groups[base.group].members.size(), 2u) << "a variant is no further member";
}

TEST(DialectLoader, AVariantMayLeaveItsCodesGroupAndAskForTheParameterBlockBefore) {
  Files files{{"t", table(plain + R"(, "G83": { "title": "peck", "group": "cycle", "does": "cycle",
    "variants": [ { "when": { "pending": "rough-turn" }, "group": null, "does": "none" } ] })")}};
  auto dialect = load(files, "t");
  ASSERT_TRUE(dialect);
  const CodeInfo &base = dialect->codes[dialect->find("G83")];
  ASSERT_EQ(base.variants.size(), 1u);
  EXPECT_EQ(base.variants[0].when.pending, CycleKind::RoughTurn);
  EXPECT_NE(base.group, noGroup);
  EXPECT_EQ(dialect->codes[base.variants[0].code].group, noGroup);
}

TEST(DialectLoader, ConditionsNameGroupsOrCodes) {
  Files files{
      {"t", table(plain + R"(, "G01": { "group": "motion" }, "G04": {}, "M05": { "notices": [
    { "rule": "r", "message": "m", "at": "P", "when": { "active": ["G00", "G01"], "with": ["G80"] } },
    { "rule": "r", "message": "m", "when": { "with": ["G80", "G04"], "without": ["G00", "G04"],
      "options": { "liveTools": false, "model": ["A", 2.50] }, "first": true,
      "broken": [ { "word": "P", "min": 1, "max": 4, "integer": true } ] } } ] })")}};
  auto dialect = load(files, "t");
  ASSERT_TRUE(dialect);
  const auto &notices = dialect->codes[dialect->find("M05")].notices;
  ASSERT_EQ(notices.size(), 2u);
  GroupIndex motion = dialect->group(StandardGroup::Motion);
  GroupIndex cycle = dialect->group(StandardGroup::Cycle);
  EXPECT_EQ(notices[0].at, letterAddress('P'));
  EXPECT_THAT(notices[0].when.active, ElementsAre(std::pair(motion, uint64_t(3))));
  EXPECT_THAT(notices[0].when.with, ElementsAre(std::pair(cycle, uint64_t(1))));
  const Condition &when = notices[1].when;
  EXPECT_TRUE(when.with.empty()) << "one of several groups is a list of codes";
  EXPECT_THAT(when.withCode, ElementsAre(dialect->find("G80"), dialect->find("G04")));
  EXPECT_THAT(when.without, ElementsAre(std::pair(motion, uint64_t(1))));
  EXPECT_THAT(when.withoutCode, ElementsAre(dialect->find("G04")));
  EXPECT_TRUE(when.first);
  ASSERT_EQ(when.options.size(), 2u);
  EXPECT_THAT(when.options[0].second, ElementsAre("false"));
  EXPECT_THAT(when.options[1].second, ElementsAre("A", "2.5"));
  ASSERT_EQ(when.broken.size(), 1u);
  EXPECT_EQ(when.broken[0].max, 4);
  EXPECT_TRUE(when.broken[0].integer);
}

TEST(DialectLoader, CodesShareNoticesByName) {
  const std::string shared =
      R"(, "M05": { "notices": [ "late", { "rule": "r", "message": "own" } ] },
    "M09": { "notices": [ "late" ] } }, "sharedNotices": { "late": [
      { "rule": "r", "message": "first" }, { "rule": "r", "message": "second" } ])";
  auto dialect = load({{"t", table(plain + shared)}}, "t");
  ASSERT_TRUE(dialect);
  const auto &notices = dialect->codes[dialect->find("M05")].notices;
  ASSERT_EQ(notices.size(), 3u);
  EXPECT_EQ(notices[1].message, "second");
  EXPECT_EQ(notices[2].message, "own");
  EXPECT_EQ(dialect->codes[dialect->find("M09")].notices.size(), 2u);
  const std::string misspelt = R"(, "M05": { "notices": [ "lated" ] } }, "sharedNotices": {
    "late": [])";
  EXPECT_THAT(errorOf({{"t", table(plain + misspelt)}}, "t"),
              HasSubstr("unknown shared notices; did you mean \"late\"?"));
}

TEST(DialectLoader, ACodeNamesItsSwitchAndWhereItLeavesIt) {
  Files files{{"t", table(plain + R"(, "M09": { "switch": { "id": "coolant", "to": "off" } },
    "G52": { "switch": { "id": "shift", "to": "on", "offByZero": true } })")}};
  auto dialect = load(files, "t");
  ASSERT_TRUE(dialect);
  const SwitchEffect &shift = dialect->codes[dialect->find("G52")].effect;
  EXPECT_TRUE(shift.on);
  EXPECT_TRUE(shift.offByZero);
  EXPECT_EQ(dialect->switches[shift.index].id, "shift");
  const SwitchEffect &coolant = dialect->codes[dialect->find("M09")].effect;
  EXPECT_FALSE(coolant.on);
  EXPECT_EQ(dialect->switches[coolant.index].id, "coolant");
  EXPECT_EQ(dialect->codes[dialect->find("G00")].effect.index, 0xFF);
}

TEST(DialectLoader, FactsOfTheControlAreTypedAndInherited) {
  const std::string facts = R"(, "facts": { "turning": { "startsInX": true },
    "variables": { "greatest": 999 } })";
  Files files{{"t", table(plain, facts)}, {"top", R"({ "id": "top", "title": "top", "extends": "t",
    "facts": { "turning": { "startsInX": null, "stepUnit": 0.001 } } })"}};
  const auto base = load(files, "t"), top = load(files, "top");
  ASSERT_TRUE(base && top);
  EXPECT_TRUE(base->facts->turning.startsInX);
  EXPECT_FALSE(top->facts->turning.startsInX);
  EXPECT_EQ(top->facts->turning.stepUnit, 0.001);
  EXPECT_EQ(top->facts->variables.greatest, 999u);
  EXPECT_EQ(load({{"t", table(plain)}}, "t")->facts->compensation.greatestTip, 9u);
  const std::string misspelt = R"(, "facts": { "turning": { "startInX": true } })";
  EXPECT_THAT(errorOf({{"t", table(plain, misspelt)}}, "t"),
              HasSubstr("facts.turning.startInX: unknown key; did you mean \"startsInX\"?"));
  const std::string number = R"(, "facts": { "turning": { "startsInX": 1 } })";
  EXPECT_THAT(errorOf({{"t", table(plain, number)}}, "t"), HasSubstr("true or false is expected"));
}

TEST(DialectLoader, AnUnknownWordOfTheVocabularyNamesItsLineAndWhatIsNear) {
  std::string codes = plain + ",\n" + R"("G83": { "words": { "Z": {},
    "P": { "role": "pek" } } })";
  EXPECT_EQ(errorOf({{"t", table(codes)}}, "t"),
            "t.json:12: codes.G83.words.P.role: unknown role \"pek\"; did you mean \"peck\"?");
  EXPECT_THAT(errorOf({{"t", table(plain + R"(, "M05": { "spindle": "sideways" })")}}, "t"),
              HasSubstr("one of any, running, clockwise, counter-clockwise, starts-itself"));
}

TEST(DialectLoader, AnUnknownKeyIsAnErrorWhereverItIs) {
  for (auto [codes, place] : std::initializer_list<std::pair<const char *, const char *>>{
           {R"("G01": { "tittle": "x" })", "codes.G01.tittle: unknown key; did you mean \"title\""},
           {R"("G01": { "words": { "Z": { "nead": "first" } } })", "codes.G01.words.Z.nead"},
           {R"("G01": { "notices": [ { "rule": "r", "message": "m", "were": {} } ] })",
            "codes.G01.notices[0].were"},
           {R"("G01": { "notices": [ { "rule": "r", "message": "m", "when": { "haz": "X" } } ] })",
            "codes.G01.notices[0].when.haz"}})
    EXPECT_THAT(errorOf({{"t", table(codes)}}, "t"), HasSubstr(place));
  EXPECT_THAT(errorOf({{"t", table(plain, ", \"limit\": {}")}}, "t"),
              HasSubstr("limit: unknown key"));
}

TEST(DialectLoader, AnErrorInAVariantNamesTheVariantOrTheInheritedPlace) {
  std::string own = plain + ",\n" + R"("G83": { "title": "a",
  "variants": [ { "when": { "any": "X" },
    "does": "flying" } ] })";
  EXPECT_THAT(errorOf({{"t", table(own)}}, "t"),
              StartsWith("t.json:13: codes.G83.variants[0].does: unknown action"));
}

TEST(DialectLoader, AnErrorNamesTheFileThatHoldsThePlace) {
  Files files{{"t", table(plain + R"(, "G01": { "group": "motoin" })")},
              {"top", "{ \"id\": \"top\", \"title\": \"x\",\n \"extends\": \"t\" }"}};
  EXPECT_THAT(errorOf(files, "top"),
              StartsWith("t.json:10: codes.G01.group: unknown group \"motoin\"; did you mean"));
  files["top"] = "{ \"id\": \"top\", \"title\": \"x\",\n \"extends\": \"s\" }";
  EXPECT_EQ(errorOf(files, "top"), "top.json:2: extends: unknown dialect \"s\"");
  files["top"] = "{ \"id\": \"top\", \"title\": \"x\",\n \"extends\": \"top\" }";
  EXPECT_THAT(errorOf(files, "top"), HasSubstr("extends itself"));
  EXPECT_EQ(errorOf(files, "none"), "unknown dialect \"none\"");
}

TEST(DialectLoader, ASyntaxErrorNamesItsLine) {
  EXPECT_THAT(errorOf({{"t", "{ \"id\": \"t\",\n\n  \"title\" }"}}, "t"), StartsWith("t.json:3: "));
  EXPECT_THAT(errorOf({{"t", ""}}, "t"), StartsWith("t.json:1: "));
  EXPECT_THAT(errorOf({{"t", "[1]"}}, "t"), HasSubstr("an object { … } is expected"));
  EXPECT_THAT(errorOf({{"t", std::string(100000, '[')}}, "t"), HasSubstr("too deep"));
}

TEST(DialectLoader, ValuesOfTheWrongKindOrRangeAreErrors) {
  for (auto [codes, message] : std::initializer_list<std::pair<const char *, const char *>>{
           {R"("G1": {})", "codes.G1: is written \"G01\""},
           {R"("X1": {})", "name of a G or M code"},
           {R"("G01": { "title": 1 })", "a string is expected"},
           {R"("G01": { "exclusive": "yes" })", "true or false is expected"},
           {R"("G01": { "takes": "X1" })", "unknown address \"1\""},
           {R"("G01": { "words": { "CR": {} } })", "unknown address \"CR\""},
           {R"("G01": { "words": { "X": { "min": "0" } } })", "a number is expected"},
           {R"("G01": { "words": { "X": { "min": 2, "max": 1 } } })", "greater than"},
           {R"("G01": { "excludes": ["XZ"] })", "a pair of address sets"},
           {R"("G01": { "opposite": "G02" })", "the table has no code \"G02\""},
           {R"("G01": { "switch": { "id": "colant" } })", "did you mean \"coolant\""},
           {R"("G01": { "needs": ["food"] })", "unknown need"},
           {R"("G01": { "notices": [ { "rule": "r", "message": "m",
                "when": { "options": { "liveTool": true } } } ] })",
            "did you mean \"liveTools\""},
           {R"("G01": { "notices": [ { "rule": "r", "message": "m",
                "when": { "active": ["G01"] } } ] })",
            "G01 has no modal group"},
           {R"("G01": { "variants": [ { "title": "x" } ] })", "a variant needs \"when\""}})
    EXPECT_THAT(errorOf({{"t", table(plain + ", " + codes)}}, "t"), HasSubstr(message));
}

TEST(MachineProfileReader, ReadsAllSections) {
  auto profile = parseMachineProfile("machine.json", R"({ "dialect": "haas-lathe",
    "axes": { "X": { "min": -200, "max": 300 } }, "spindle": { "minSpeed": 20, "maxSpeed": 6000 },
    "feed": { "max": 10000, "rapid": 20000 },
    "tools": { "4": { "kind": "endmill", "radius": 5 }, "2": { "kind": "turning", "tip": 3 } },
    "offsets": { "G54": { "X": 0, "Z": 10.5 } },
    "stock": { "min": { "Z": -20 }, "max": { "X": 100, "Y": 60, "Z": 0 } },
    "options": { "liveTools": false, "setting95": 1.0, "machineModel": "SL-30", "agap": null } })");
  ASSERT_TRUE(bool(profile)) << llvm::toString(profile.takeError());
  EXPECT_EQ(profile->dialect, "haas-lathe");
  EXPECT_EQ(profile->axes[unsigned(Axis::X)].min, -200);
  EXPECT_EQ(profile->spindleMax, 6000);
  EXPECT_EQ(profile->rapid, 20000);
  EXPECT_TRUE(profile->hasTools);
  EXPECT_EQ(profile->tools.at(4).radius, 5);
  EXPECT_EQ(profile->tools.at(2).tip, 3);
  EXPECT_EQ(profile->offsets.at("G54")[unsigned(Axis::Z)], 10.5);
  EXPECT_EQ(profile->offsets.at("G54")[unsigned(Axis::Y)], std::nullopt);
  ASSERT_TRUE(profile->stock);
  EXPECT_EQ(profile->stock->max[1], 60);
  EXPECT_EQ(profile->option("liveTools"), llvm::StringRef("false"));
  EXPECT_EQ(profile->number("setting95"), 1.0);
  EXPECT_EQ(profile->option("agap"), std::nullopt) << "null is: not known";
  EXPECT_EQ(profile->option("other"), std::nullopt);
}

TEST(MachineProfileReader, NamesThePlaceOfWhatItDoesNotKnow) {
  EXPECT_EQ(profileError("{ \"tools\": {\n \"4\": {\n \"radios\": 5 } } }"),
            "machine.json:3: tools.4.radios: unknown key; did you mean \"radius\"?");
  EXPECT_THAT(profileError(R"({ "axes": { "Q": {} } })"),
              HasSubstr("axes.Q: unknown axis; one of"));
  EXPECT_THAT(profileError(R"({ "axes": { "X": { "min": 5, "max": 1 } } })"), HasSubstr("greater"));
  EXPECT_THAT(profileError(R"({ "tools": { "T4": {} } })"), HasSubstr("a tool number"));
  EXPECT_THAT(profileError(R"({ "tools": { "4": { "tip": 12 } } })"), HasSubstr("from 0 to 9"));
  EXPECT_THAT(profileError(R"({ "spindle": { "maxSpeed": -1 } })"), HasSubstr("not below 0"));
  EXPECT_THAT(profileError("{ \"stock\": 5 }"), HasSubstr("an object"));
  EXPECT_THAT(profileError("{"), StartsWith("machine.json:1: "));
}

TEST(Overlay, LaysCodesAndOptionsOfTheProfileOverTheDialect) {
  Files files{{"t", table(plain + R"(, "M08": { "title": "coolant", "does": "coolant-on" },
    "M51": { "title": "user function", "does": "switch", "words": { "P": {} } })")}};
  auto dialect = load(files, "t");
  ASSERT_TRUE(dialect);
  auto changed = overlay(dialect, "machine.json", R"({ "options": { "liveTools": true },
    "codes": { "M51": { "does": "none", "summary": "door" },
               "M8": { "does": "coolant-on", "notices": [] }, "M77": { "does": "none" } } })");
  ASSERT_TRUE(bool(changed)) << llvm::toString(changed.takeError());
  const Dialect &result = **changed;
  EXPECT_EQ(result.options.lookup("liveTools"), "true");
  EXPECT_EQ(result.options.lookup("model"), "A");
  const CodeInfo &door = result.codes[result.find("M51")];
  EXPECT_EQ(door.title, "door");
  EXPECT_EQ(door.takes, 0u) << "a code that does something else keeps nothing";
  EXPECT_EQ(result.codes[result.find("M08")].title, "coolant");
  EXPECT_NE(result.find("M77"), noCode);
  EXPECT_EQ(dialect->find("M77"), noCode) << "the dialect itself does not change";
}

TEST(Overlay, LaysOverWhatTheTableSaysOfTheControlThatTheProfileNames) {
  const auto dialect = builtin("sinumerik");
  const auto of = [&](llvm::StringRef control) {
    const std::string text = ("{ \"options\": { \"control\": \"" + control + "\" } }").str();
    auto changed = overlay(dialect, "machine.json", text);
    EXPECT_TRUE(bool(changed)) << llvm::toString(changed.takeError());
    return changed ? *changed : dialect;
  };
  EXPECT_TRUE(dialect->lexical.structures);
  EXPECT_EQ(dialect->codes[dialect->find("G58")].action, Action::FrameAdd);
  const auto small = of("802D");
  EXPECT_FALSE(small->lexical.structures);
  EXPECT_EQ(small->limits.callDepth, 7) << "eight levels with the main program";
  EXPECT_EQ(small->codes[small->find("G58")].action, Action::WorkOffset);
  EXPECT_EQ(small->find("G505"), noCode);
  EXPECT_EQ(of("810D")->limits.blockLength, 242);
  EXPECT_NE(of("840D")->find("G505"), noCode);
  EXPECT_NE(of("840D")->find("G599"), noCode);
  auto unknown = overlay(dialect, "machine.json", R"({ "options": { "control": "802" } })");
  ASSERT_FALSE(bool(unknown));
  EXPECT_THAT(llvm::toString(unknown.takeError()), HasSubstr("did you mean \"802D\"?"));
}

TEST(Overlay, ThePriorityBlockSetsTheModesOfTheStart) {
  const auto with = [](const char *block) {
    return overlay(builtin("mefi"), "machine.json",
                   std::string(R"({ "options": { "priorityBlock": ")") + block + "\" } }");
  };
  auto set = with("G17 G90 G94");
  ASSERT_TRUE(bool(set)) << llvm::toString(set.takeError());
  const Dialect &dialect = **set;
  const CodeInfo &absolute = dialect.codes[dialect.find("G90")];
  EXPECT_EQ(dialect.groups[absolute.group].initial, absolute.bit);
  auto wrong = with("G17 X5");
  ASSERT_FALSE(bool(wrong));
  EXPECT_THAT(llvm::toString(wrong.takeError()), HasSubstr("\"X5\" is no code of a modal group"));
}

TEST(Overlay, NamesThePlaceOfAnErrorInTheProfile) {
  auto dialect = load({{"t", table(plain + R"(, "M08": { "does": "coolant-on" })")}}, "t");
  ASSERT_TRUE(dialect);
  auto changed =
      overlay(dialect, "machine.json", "{ \"codes\": {\n \"M8\": { \"doess\": \"none\" } } }");
  ASSERT_FALSE(bool(changed));
  EXPECT_EQ(llvm::toString(changed.takeError()),
            "machine.json:2: codes.M08.doess: unknown key; did you mean \"does\"?");
  auto option = overlay(dialect, "machine.json", "{ \"options\": {\n\n \"liveTool\": true } }");
  ASSERT_FALSE(bool(option));
  EXPECT_EQ(llvm::toString(option.takeError()),
            "machine.json:3: options.liveTool: unknown option of t; did you mean \"liveTools\"?");
}

TEST(JsonPlace, FindsKeysAndElementsInAnyLayoutAndNothingInRubbish) {
  std::string text = "{ \"a\": [1, {\"b\\\"\": 2}, \"}\"],\n\"c\": { \"d\": true } }";
  EXPECT_EQ(lineAt(text, *findJsonPlace(text, {{"c", 0, false}, {"d", 0, false}})), 2u);
  EXPECT_EQ(findJsonPlace(text, {{"a", 0, false}, {"", 2, true}}), text.find("\"}\""));
  EXPECT_FALSE(findJsonPlace(text, {{"a", 0, false}, {"", 3, true}}));
  EXPECT_FALSE(findJsonPlace(text, {{"x", 0, false}}));
  EXPECT_EQ(findJsonMember(text, "c"), llvm::StringRef("{ \"d\": true }"));
  for (size_t length = 0; length < text.size(); ++length) {
    llvm::StringRef cut = llvm::StringRef(text).take_front(length);
    findJsonPlace(cut, {{"c", 0, false}, {"d", 0, false}});
    findJsonMember(cut, "c");
  }
  EXPECT_FALSE(findJsonPlace("{:::}", {{"x", 0, false}}));
}

TEST(JsonPlace, CountsBracketsOutsideOfStringsOnly) {
  EXPECT_FALSE(
      nestsTooDeep("{ \"" + std::string(100, '[') + "\\\"" + std::string(100, '[') + "\" }"));
  EXPECT_TRUE(nestsTooDeep("{ \"a\\\\\": " + std::string(100, '[')));
  EXPECT_FALSE(nestsTooDeep("\""));
  EXPECT_FALSE(nestsTooDeep("[[]] [[]]"));
}

TEST(BuiltinTables, EveryDialectLoadsAndIsWhatItsFileSays) {
  std::set<std::string> ids;
  for (const RulesetFile &file : builtinRulesetFiles()) {
    if (!file.name.startswith("dialects/"))
      continue;
    auto summary = summarize(file.name, file.text);
    ASSERT_TRUE(bool(summary)) << llvm::toString(summary.takeError());
    EXPECT_EQ("dialects/" + summary->id + ".json", file.name.str());
    auto dialect = builtin(summary->id);
    ASSERT_TRUE(dialect);
    EXPECT_EQ(dialect->abstract, summary->abstract);
    EXPECT_EQ(dialect->detect.empty(), dialect->abstract) << dialect->id;
    ids.insert(summary->id);
  }
  EXPECT_EQ(listDialects().size(), ids.size());
  for (const char *id : {"iso-base", "iso-turning", "iso-milling"})
    EXPECT_TRUE(ids.count(id)) << id;
}

TEST(BuiltinTables, EveryCodeHasATitleAndASource) {
  for (const DialectSummary &summary : listDialects()) {
    auto dialect = builtin(summary.id);
    ASSERT_TRUE(dialect);
    for (const CodeInfo &code : dialect->codes) {
      EXPECT_FALSE(code.title.empty()) << summary.id << " " << code.name;
      EXPECT_FALSE(code.source.empty()) << summary.id << " " << code.name;
    }
    for (const SwitchInfo &info : dialect->switches) {
      const llvm::StringRef off = llvm::StringRef(info.off).split(" ").first.split("(").first;
      const std::string bare =
          off.split(':').first.str() + ">"; // `<DRA:0>` is `<DRA>` with a value
      // What only the table asks for says what the program has done, and is never off again.
      EXPECT_TRUE((off.empty() && info.leftOn.empty()) || off.contains("=") ||
                  dialect->find(off) != noCode ||
                  dialect->find(bare) != noCode) // or a word with a value
          << summary.id << " " << info.id;
    }
  }
}

TEST(BuiltinTables, EveryExampleOfAMachineFitsItsDialect) {
  unsigned examples = 0;
  for (const RulesetFile &file : builtinRulesetFiles()) {
    if (!file.name.startswith("machines/"))
      continue;
    ++examples;
    auto profile = parseMachineProfile(file.name, file.text);
    ASSERT_TRUE(bool(profile)) << llvm::toString(profile.takeError());
    auto changed = overlay(builtin(profile->dialect), file.name, file.text);
    EXPECT_TRUE(bool(changed)) << llvm::toString(changed.takeError());
  }
  EXPECT_GE(examples, 2u);
}

TEST(BuiltinTables, EveryMarkIsAValidExpressionWithAReason) {
  for (const DialectSummary &summary : listDialects())
    for (const DetectMark &mark : summary.detect) {
      std::string why;
      EXPECT_TRUE(llvm::Regex(mark.pattern).isValid(why)) << mark.pattern << ": " << why;
      EXPECT_NE(mark.score, 0) << mark.pattern;
    }
}

} // namespace
} // namespace ncvet
