// The extension of VS Code says of languages and settings what the server does, and can be packed.
#include "formats/dialect/loader.h"
#include "lsp/features/showing/semantic_tokens.h"
#include "lsp/server/settings.h"
#include "tests/support/outer_program.h"
#include "tests/support/run_program.h"

#include "llvm/Support/Endian.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

using namespace ncvet;
using namespace ncvet::test;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path extension = fs::path(NCVET_SOURCE_DIR) / "lsp" / "editors" / "vscode";

const Json &manifest() {
  static const Json json = Json::parse(contentsOf(extension / "package.json"));
  return json;
}

const Json &contributed(const char *what) { return manifest()["contributes"][what]; }

/// Settings of the client itself, which the server takes no notice of.
const std::set<std::string> ofTheClient = {"ncvet.path", "ncvet.trace.server"};

TEST(VscodeExtension, ItsSettingsAreThoseThatTheServerReads) {
  std::vector<std::string> shown, read;
  for (const auto &[name, property] : contributed("configuration")["properties"].items())
    if (!ofTheClient.count(name))
      shown.push_back(name);
  for (const std::string &name : lsp::settingNames())
    read.push_back("ncvet." + name);
  EXPECT_EQ(shown, read);
}

TEST(VscodeExtension, TheDefaultsOfItsSettingsAreTaken) {
  Json defaults = Json::object();
  for (const auto &[name, property] : contributed("configuration")["properties"].items()) {
    std::string pointer = name;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    defaults[Json::json_pointer("/" + pointer)] = property["default"];
    EXPECT_TRUE(property.contains("markdownDescription")) << name;
  }
  std::vector<std::string> problems;
  const lsp::Settings with = lsp::readSettings(defaults["ncvet"], problems);
  EXPECT_EQ(problems, std::vector<std::string>());
  const lsp::Settings without = lsp::readSettings(nullptr, problems);
  EXPECT_EQ(with.session.dialect, without.session.dialect);
  EXPECT_EQ(with.session.profile, without.session.profile);
  EXPECT_EQ(with.session.configFile, without.session.configFile);
  EXPECT_EQ(with.session.machine.has_value(), without.session.machine.has_value());
  EXPECT_EQ(with.session.rules.select, without.session.rules.select);
  EXPECT_EQ(with.session.rules.ignore, without.session.rules.ignore);
  EXPECT_EQ(with.workspaceDiagnostics, without.workspaceDiagnostics);
  EXPECT_EQ(with.hints.units, without.hints.units);
  EXPECT_EQ(with.hints.values, without.hints.values);
  EXPECT_EQ(with.hints.motion, without.hints.motion);
  EXPECT_EQ(with.format.spaces, without.format.spaces);
  EXPECT_EQ(with.format.renumber, without.format.renumber);
  EXPECT_EQ(with.format.firstNumber, without.format.firstNumber);
}

TEST(VscodeExtension, ItsLanguagesAreTheControls) {
  std::vector<std::string> shown, controls = {"gcode"};
  for (const Json &language : contributed("languages")) {
    shown.push_back(language["id"]);
    EXPECT_TRUE(fs::exists(extension / language["configuration"].get<std::string>())) << language;
  }
  for (const DialectSummary &dialect : listDialects())
    if (!dialect.abstract)
      controls.push_back("ncvet-" + dialect.id);
  EXPECT_EQ(shown, controls);
}

/// An ending of the language of one control is in no table but this control's; all others are
/// `gcode`, for which the control is found out.
TEST(VscodeExtension, ItsFileEndingsAreThoseOfTheTables) {
  std::map<std::string, std::set<std::string>> languages; // by ending
  for (const DialectSummary &dialect : listDialects())
    for (const std::string &ending : dialect.extensions)
      if (ending != "txt") // any text: an editor's own
        languages["." + ending].insert("ncvet-" + dialect.id);
  languages[".gcode"] = {};
  std::set<std::string> shown, known;
  for (const Json &language : contributed("languages"))
    for (const std::string ending : language.value("extensions", Json::array())) {
      EXPECT_TRUE(shown.insert(ending).second) << ending;
      if (language["id"] != "gcode") {
        EXPECT_EQ(languages[ending], std::set<std::string>{language["id"]}) << ending;
      }
    }
  for (const auto &[ending, claims] : languages)
    known.insert(ending);
  EXPECT_EQ(shown, known);
}

TEST(VscodeExtension, HasAScopeForEveryKindOfToken) {
  std::set<std::string> scopes, types;
  for (const auto &[name, scope] : contributed("semanticTokenScopes")[0]["scopes"].items())
    if (name.find('.') == std::string::npos)
      scopes.insert(name);
  for (const llvm::StringRef name : lsp::tokenTypeNames())
    types.insert(name.str());
  EXPECT_EQ(scopes, types);
}

TEST(VscodeExtension, ItsCommandsAreMade) {
  const std::string source = contentsOf(extension / "src" / "extension.ts");
  for (const Json &command : contributed("commands"))
    EXPECT_THAT(source, testing::HasSubstr("registerCommand('" +
                                           command["command"].get<std::string>() + "'"));
}

TEST(VscodeExtension, IsUnderTheLicenceOfTheProject) {
  EXPECT_EQ(contentsOf(extension / "LICENSE"), contentsOf(fs::path(NCVET_SOURCE_DIR) / "LICENSE"));
}

/// Names and sizes of the files in a zip archive, from its directory.
std::map<std::string, uint32_t> filesOfZip(const std::string &bytes) {
  std::map<std::string, uint32_t> files;
  constexpr size_t header = 46; // of an entry, before the name
  const std::string mark = "PK\1\2";
  for (size_t at = bytes.find(mark); at != std::string::npos && at + header <= bytes.size();
       at = bytes.find(mark, at + header)) {
    using llvm::support::endian::read16le;
    using llvm::support::endian::read32le;
    files[bytes.substr(at + header, read16le(&bytes[at + 28]))] = read32le(&bytes[at + 24]);
  }
  return files;
}

TEST(VscodeExtension, IsPackedWithItsClient) {
  const auto modules = nodeModules(extension);
  if (!modules)
    GTEST_SKIP() << "npm cannot fetch what the extension is built with: it is not packed";
  const TemporaryFolder temporary;
  const fs::path copy = temporary.path() / "vscode";
  fs::copy(extension, copy, fs::copy_options::recursive);
  fs::remove_all(copy / "dist");
  fs::remove_all(copy / "node_modules");
  fs::create_directory_symlink(*modules, copy / "node_modules");
  const fs::path log = temporary.path() / "log";
  ASSERT_EQ(runOuter({"npm", "--prefix", copy.string(), "run", "package"}, log, 300), 0)
      << contentsOf(log);
  const std::string name = "ncvet-" + manifest()["version"].get<std::string>() + ".vsix";
  const std::map<std::string, uint32_t> files = filesOfZip(contentsOf(copy / name));
  EXPECT_EQ(files.count("extension/README.md"), 1u) << contentsOf(log);
  EXPECT_EQ(files.count("extension/LICENSE.txt"), 1u);
  EXPECT_EQ(files.count("extension/package.json"), 1u);
  EXPECT_EQ(files.count("extension/languages/parentheses.json"), 1u);
  const auto client = files.find("extension/dist/extension.js");
  ASSERT_NE(client, files.end());
  EXPECT_GT(client->second, 100000u); // the protocol's client is in it
  for (const auto &[file, size] : files) {
    EXPECT_EQ(file.find("node_modules"), std::string::npos) << file;
    EXPECT_EQ(file.find("/src/"), std::string::npos) << file;
  }

  // It can be loaded where there is an editor around it.
  const std::string load =
      "const any = new Proxy(function () {}, { get: (f, key) => key === 'prototype' ? f.prototype "
      ": key === Symbol.toPrimitive ? () => '' : any, apply: () => any, construct: () => ({}) });"
      "const module = require('module'), old = module._load;"
      "module._load = (name, ...rest) => name === 'vscode' ? any : old(name, ...rest);"
      "const client = require(process.argv[1]);"
      "process.exit(client.activate && client.deactivate ? 0 : 3);";
  EXPECT_EQ(runOuter({"node", "-e", load, (copy / "dist" / "extension.js").string()}, log, 60), 0)
      << contentsOf(log);
}

} // namespace
