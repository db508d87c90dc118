// Settings of the client: what there is not is said; the language of a text names its control where
// nothing else does.
#include "lsp/server/settings.h"
#include "tests/support/language_client.h"
#include "tests/support/process.h"

#include "gtest/gtest.h"

namespace ncvet {
namespace {

using test::Json;
using test::LanguageClient;
using test::Shop;

/// A block that only a Sinumerik reads: `unknown` by any other.
const char *const sinumerikOnly = "G54 G17 G90\nTRANS X10\nG0 X0 Y0\nM30\n";

std::vector<std::string> problemsOf(const Json &settings) {
  std::vector<std::string> problems;
  lsp::readSettings(settings, problems);
  return problems;
}

TEST(ServerSettings, WhatThereIsNotIsSaid) {
  EXPECT_EQ(problemsOf({{"ingore", Json::array()}}),
            std::vector<std::string>{"ncvet.ingore: there is no such setting"});
  EXPECT_EQ(problemsOf({{"hints", {{"motions", true}}}}),
            std::vector<std::string>{"ncvet.hints.motions: there is no such setting"});
  // Clients keep their own settings in the same section.
  EXPECT_EQ(problemsOf({{"path", "/opt/ncvet"}, {"trace", {{"server", "off"}}}}),
            std::vector<std::string>());
  EXPECT_EQ(problemsOf(nullptr), std::vector<std::string>());
}

TEST(ServerSettings, HaveNames) {
  const std::vector<std::string> names = lsp::settingNames();
  for (const char *name : {"dialect", "severity", "hints.units"})
    EXPECT_TRUE(llvm::is_contained(names, name)) << name;
  for (const char *name : {"hints", "path"})
    EXPECT_FALSE(llvm::is_contained(names, name)) << name;
}

unsigned findings(const Shop &shop, const std::string &language, const Json &settings) {
  LanguageClient client;
  client.initialize(Json::object(), settings);
  const std::string path = (shop.path() / "PART.MPF").string();
  client.open(path, sinumerikOnly, language);
  return unsigned(client.diagnostics(path).size());
}

TEST(ServerSettings, TheLanguageOfATextNamesItsControl) {
  const Shop shop;
  const unsigned rightly = findings(shop, "ncvet-sinumerik", Json::object());
  const unsigned wrongly = findings(shop, "ncvet-haas-mill", Json::object());
  EXPECT_LT(rightly, wrongly);
  EXPECT_EQ(findings(shop, "gcode", Json::object()), rightly);
  EXPECT_EQ(findings(shop, "ncvet-no-such-control", Json::object()), rightly);
}

TEST(ServerSettings, ASettingOrAConfigurationThatNamesAControlGoesBeforeTheLanguage) {
  const Shop plain;
  const unsigned rightly = findings(plain, "ncvet-sinumerik", Json::object());
  EXPECT_EQ(findings(plain, "ncvet-haas-mill", {{"dialect", "sinumerik"}}), rightly);
  Shop configured;
  configured.file(".ncvet.json", R"({"dialect": "sinumerik"})");
  EXPECT_EQ(findings(configured, "ncvet-haas-mill", Json::object()), rightly);
}

} // namespace
} // namespace ncvet
