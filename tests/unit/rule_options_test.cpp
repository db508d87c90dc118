// Options of rules: their types, and what is said of those that there are not.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/rule_page.h"
#include "analyzer/rule/rule_settings.h"
#include "analyzer/setup/config.h"
#include "analyzer/setup/session.h"
#include "formats/dialect/loader.h"
#include "tests/support/run_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ncvet {
namespace {

std::string problemOfTable(llvm::StringRef text) {
  llvm::Error wrong = checkRulesOfTable("own.json", text);
  return wrong ? llvm::toString(std::move(wrong)) : std::string();
}

/// What is said of a configuration, without the name of its folder.
std::string problemOfConfig(const std::string &text) {
  test::TemporaryFolder folder;
  const std::string file = (folder.path() / ".ncvet.json").string();
  std::ofstream(file) << text;
  auto config = loadConfig(file);
  const std::string problem = config ? std::string() : llvm::toString(config.takeError());
  return problem.substr(std::min(problem.size(), problem.find(".ncvet.json")));
}

TEST(OptionsOfTables, EveryBuiltInTableNamesRulesAndOptionsThatThereAre) {
  for (const RulesetFile &file : builtinRulesetFiles()) {
    if (!file.name.startswith("dialects/"))
      continue;
    EXPECT_EQ("", llvm::toString(checkRulesOfTable(file.name, file.text)));
  }
}

TEST(SeveritiesOfTables, DifferFromThePageOnlyWithAReason) {
  std::map<std::string, std::string> parents;
  std::map<std::string, std::map<std::string, std::string>> given; ///< by table, by rule
  std::vector<std::pair<std::string, nlohmann::json>> tables;
  for (const RulesetFile &file : builtinRulesetFiles())
    if (file.name.startswith("dialects/")) {
      tables.emplace_back("", nlohmann::json::parse(file.text.begin(), file.text.end()));
      tables.back().first = tables.back().second["id"];
      parents[tables.back().first] = tables.back().second.value("extends", "");
    }
  for (const auto &[id, table] : tables)
    if (table.contains("rules"))
      for (const auto &[rule, entry] : table["rules"].items())
        if (entry.contains("severity"))
          given[id][rule] = entry["severity"];
  const auto otherwise = [&](const std::string &id, const std::string &rule) {
    for (std::string table = parents[id]; !table.empty(); table = parents[table])
      if (given[table].count(rule))
        return given[table][rule];
    for (const RuleEntry &known : allRules())
      if (known.info.id == rule)
        return toString(known.info.severity).str();
    return std::string();
  };
  size_t reasons = 0;
  for (const auto &[id, table] : tables)
    for (const auto &[rule, severity] : given[id]) {
      EXPECT_NE(otherwise(id, rule), severity) << id << ": " << rule << ": says it again";
      EXPECT_LT(10u, table["rules"][rule].value("because", "").size())
          << id << ": " << rule << ": why " << severity << "?";
      ++reasons;
    }
  EXPECT_LT(20u, reasons);
}

TEST(OptionsOfTables, WhatThereIsNotIsToldWithItsFileLineAndKey) {
  EXPECT_EQ("own.json:2: rules.feed-implausable: unknown rule \"feed-implausable\"; did you mean "
            "\"feed-implausible\"?",
            problemOfTable("{ \"rules\": {\n \"feed-implausable\": { \"enabled\": false } } }"));
  EXPECT_EQ("own.json:3: rules.feed-implausible.perMinute: unknown option \"perMinute\" of rule "
            "\"feed-implausible\"; one of perMinuteBelow, perMinuteAbove, perRevolutionBelow, "
            "perRevolutionAbove, roughingAbove, statedMode",
            problemOfTable("{ \"rules\": {\n \"feed-implausible\": {\n \"perMinute\": 1 } } }"));
  EXPECT_EQ("own.json:2: controls.840D.rules.arc-helix-axis.slack: rule \"arc-helix-axis\" has no "
            "options",
            problemOfTable(R"({ "controls": { "840D": { "rules": {
                                "arc-helix-axis": { "slack": 1 } } } } })"));
  EXPECT_EQ("", problemOfTable(R"({ "rules": { "feed-implausible": { "severity": "style",
                                    "enabled": true, "perMinuteBelow": 2 } } })"));
}

TEST(OptionsOfTables, AnOwnTableIsCheckedWithThoseThatItExtends) {
  test::TemporaryFolder folder;
  const std::string file = (folder.path() / "own.json").string();
  std::ofstream(file) << R"({ "id": "own", "title": "own", "extends": "base-of-own" })";
  std::ofstream((folder.path() / "base-of-own.json").string())
      << R"({ "id": "base-of-own", "title": "base", "extends": "haas-mill",
              "rules": { "motion-useless-move": { "zero": "yes" } } })";
  OwnDialects own;
  ASSERT_EQ("own", llvm::cantFail(own.add(file)));
  ASSERT_TRUE(bool(loadDialect("own", own.source())));
  const std::string problem = llvm::toString(own.checkRules());
  EXPECT_NE(std::string::npos, problem.find("base-of-own.json:2: rules.motion-useless-move.zero: "
                                            "option \"zero\" is true or false"))
      << problem;
}

TEST(OptionsOfConfigurations, FlagsAreTrueOrFalseAndInOlderFilesOneOrZero) {
  for (const char *value : {"true", "false", "1", "0"})
    EXPECT_EQ("", problemOfConfig(std::string(R"({"options": {"motion-useless-move": {"zero": )") +
                                  value + "}}}"))
        << value;
  for (const char *value : {"2", "\"true\"", "null"})
    EXPECT_EQ(".ncvet.json:1: options.motion-useless-move.zero: option \"zero\" is true or false",
              problemOfConfig(std::string(R"({"options": {"motion-useless-move": {"zero": )") +
                              value + "}}}"))
        << value;
}

TEST(OptionsOfConfigurations, ChoicesAreNamesAndInOlderFilesTheirIndex) {
  for (const char *value : {"\"never\"", "\"afterCut\"", "\"always\"", "0", "1", "2"})
    EXPECT_EQ("",
              problemOfConfig(std::string(R"({"options": {"spindle-left-on": {"atToolChange": )") +
                              value + "}}}"))
        << value;
  for (const char *value : {"3", "true", "\"sometimes\"", "0.5"})
    EXPECT_EQ(".ncvet.json:1: options.spindle-left-on.atToolChange: option \"atToolChange\" is one "
              "of never, afterCut, always",
              problemOfConfig(std::string(R"({"options": {"spindle-left-on": {"atToolChange": )") +
                              value + "}}}"))
        << value;
}

TEST(OptionsOfConfigurations, NumbersHaveARange) {
  EXPECT_EQ(".ncvet.json:1: options.feed-implausible.perMinuteBelow: option \"perMinuteBelow\" "
            "must be at least 0",
            problemOfConfig(R"({"options": {"feed-implausible": {"perMinuteBelow": -1}}})"));
  EXPECT_EQ(".ncvet.json:1: options.feed-implausible.perMinuteBelow: a number is expected",
            problemOfConfig(R"({"options": {"feed-implausible": {"perMinuteBelow": true}}})"));
}

TEST(OptionsOfRules, AreReadAsTheirType) {
  const auto dialect = llvm::cantFail(loadDialect("haas-mill", builtinDialects()));
  const MachineProfile machine;
  RuleOverride given;
  given.options["flag"] = 1.0;
  given.options["number"] = 2.5;
  given.options["name"] = std::string("b");
  given.options["index"] = 2.0;
  const SortedCodes sorted(*dialect);
  const Subscriptions to(*dialect, machine, &given, sorted);
  EXPECT_TRUE(to.flag("flag"));
  EXPECT_FALSE(to.flag("other"));
  EXPECT_TRUE(to.flag("other", true));
  EXPECT_EQ(2.5, to.number("number", 1));
  EXPECT_EQ(1, to.number("other", 1));
  EXPECT_EQ(1u, to.choice("name", {"a", "b", "c"}, 0));
  EXPECT_EQ(2u, to.choice("index", {"a", "b", "c"}, 0));
  EXPECT_EQ(1u, to.choice("other", {"a", "b", "c"}, 1));
}

/// Rules that report `G51 P0` of a modern FANUC, which its table tells as the cycle's, and a
/// work offset that there is not, which it tells as the rule's own.
std::vector<std::string>
rulesThatReport(llvm::function_ref<RuleSelection(const Dialect &)> select) {
  std::vector<std::string> rules;
  for (const test::Seen &seen : test::analyseProgram(
           "fanuc-mill",
           {{"O1.nc", "O1 (PLATE)\nG17 G21 G90 G54\nG51 X0 Y0 P0\nG50\nG54.1 P999\n"
                      "M30\n"}},
           "", select))
    rules.push_back(std::to_string(seen.line) + " " + seen.rule);
  return rules;
}

TEST(NamesOfTables, AFindingAtACodeIsToldAndSelectedByTheNameThatTheManualHasForIt) {
  const auto selecting = [](llvm::StringRef id) {
    return [=](const Dialect &dialect) { return test::only(dialect, *test::ruleNamed(id)); };
  };
  using testing::ElementsAre;
  EXPECT_THAT(rulesThatReport(selecting("cycle-parameter-out-of-range")),
              ElementsAre("3 cycle-parameter-out-of-range"));
  EXPECT_THAT(rulesThatReport(selecting("block-value-out-of-range")),
              ElementsAre("3 cycle-parameter-out-of-range", "5 block-value-out-of-range"))
      << "by its own name too";
  EXPECT_THAT(rulesThatReport([](const Dialect &dialect) {
                RuleSelection all = RuleSelection::defaults(dialect);
                for (size_t i = 0; i < all.enabled.size(); ++i) {
                  const llvm::StringRef id = allRules()[i].info.id;
                  all.enabled[i] = id == "block-value-out-of-range";
                }
                return all;
              }),
              ElementsAre("5 block-value-out-of-range"))
      << "what is told by a name that is left out is left out";
}

TEST(OptionsOfPages, DefaultsAreOfTheirType) {
  for (const RuleEntry &entry : allRules())
    for (const RuleOption &option : readRulePage(entry.info).options) {
      const std::string name = (entry.info.id + "." + option.name).str();
      EXPECT_FALSE(option.help.empty()) << name;
      if (option.type == RuleOption::Type::Choice) {
        EXPECT_LT(size_t(option.fallback), option.names.size()) << name;
      } else if (option.type == RuleOption::Type::Number) {
        EXPECT_TRUE(option.min) << name;
        EXPECT_GE(option.fallback, option.min.value_or(0)) << name;
        EXPECT_FALSE(option.max == 1 && option.fallback == 0 && option.name != "relative")
            << name << " looks like a flag";
      }
    }
}

} // namespace
} // namespace ncvet
