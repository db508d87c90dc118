// The extension of VS Code says of languages and settings what the server does, and can be packed.
#include "formats/dialect/loader.h"
#include "lsp/features/showing/semantic_tokens.h"
#include "lsp/server/settings.h"
#include "tests/support/packed_extension.h"
#include "tests/support/places.h"
#include "tests/support/process.h"
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

const fs::path &extension = extensionFolder;

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
/// `gcode`, whose control is found out.
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
  std::string source;
  for (const auto &file : fs::directory_iterator(extension / "src"))
    source += contentsOf(file.path());
  for (const Json &command : contributed("commands"))
    EXPECT_THAT(source, testing::HasSubstr("registerCommand('" +
                                           command["command"].get<std::string>() + "'"));
}

TEST(VscodeExtension, IsUnderTheLicenceOfTheProject) {
  EXPECT_EQ(contentsOf(extension / "LICENSE"),
            contentsOf(fs::path(places::sourceFolder()) / "LICENSE"));
}

/// The text of a snippet as it is before anything is filled in, and where its rest goes.
std::string plainBody(const Json &snippet, const std::string &rest) {
  std::string body;
  for (const std::string line : snippet["body"])
    body += line + "\n";
  std::map<std::string, std::string> values; // a stop is given its value where it is first
  std::string plain;
  for (size_t at = 0; at < body.size(); ++at) {
    if (body[at] != '$') {
      plain += body[at];
    } else if (body[at + 1] == '0') {
      plain += rest;
      ++at;
    } else {
      const size_t colon = body.find(':', at), end = body.find('}', at);
      plain += values
                   .try_emplace(body.substr(at + 2, colon - at - 2),
                                body.substr(colon + 1, end - colon - 1))
                   .first->second;
      at = end;
    }
  }
  return plain;
}

/// Every snippet is a part of a program in which ncvet finds nothing, in the head of its control.
TEST(VscodeExtension, ItsSnippetsAreGoodPrograms) {
  const Shop shop;
  std::map<std::string, std::string> controls; // and a name for a program
  for (const DialectSummary &dialect : listDialects())
    if (!dialect.abstract)
      controls[dialect.id] =
          "O1001." + (dialect.extensions.empty() ? "nc" : dialect.extensions.front());
  for (const Json &contribution : contributed("snippets")) {
    const std::string control =
        llvm::StringRef(contribution["language"].get_ref<const std::string &>())
            .drop_front(llvm::StringRef("ncvet-").size())
            .str();
    const std::string file = controls[control];
    EXPECT_EQ(controls.erase(control), 1u) << control;
    const Json snippets =
        Json::parse(contentsOf(extension / contribution["path"].get<std::string>()));
    for (const auto &[name, snippet] : snippets.items()) {
      const bool head = name == "Program head";
      const std::string program =
          plainBody(snippets["Program head"], head ? "" : plainBody(snippet, ""));
      const auto checked = shop.run(
          {"check", "--dialect", control, "--fail-on", "style", "-", "--stdin-filename", file},
          program);
      EXPECT_EQ(checked.exitCode, 0) << control << ": " << name << "\n" << checked.out << program;
    }
  }
  EXPECT_TRUE(controls.empty()) << controls.begin()->first << " has no snippets";
}

/// Texts that are no programs, though they are made of letters and numbers.
constexpr const char *notPrograms[] = {
    "Dear colleague,\nthe fixture of O0100 is ready.\nRun G54 with X10 first.\nThanks\n",
    "#include <stdio.h>\n#define X10 1\nint G1(int X) { return X; }\n",
    "%FSLAX46Y46*%\n%MOMM*%\nG04 Layer: copper*\nD10*\nX10Y20D02*\nX20Y20D01*\nM02*\n",
    "M48\nMETRIC,TZ\nT1C0.8\n%\nG05\nT1\nX10Y20\nX20Y20\nT0\nM30\n",
    "P2\n# a picture\n3 2\n255\n0 1 2\n3 4 5\n",
    "0 BEGIN PGM PLATE MM\n1 TOOL CALL 1 Z S1200\n2 L X+0 Y+0 R0 FMAX M3\n3 END PGM PLATE MM\n",
    "1\n00:00:01,000 --> 00:00:02,000\nHello\n\n2\n00:00:03,000 --> 00:00:04,000\nWorld\n",
    "G1 G2 G3\n",
    ""};

/// Makes `NAME.js` in a folder of a source of the extension that needs no editor.
void compile(const fs::path &modules, const std::string &name, const fs::path &folder) {
  const fs::path log = folder / "log";
  ASSERT_EQ(runOuter({(modules / ".bin" / "esbuild").string(),
                      (extension / "src" / (name + ".ts")).string(), "--format=cjs",
                      "--outfile=" + (folder / (name + ".js")).string()},
                     log, 60),
            0)
      << contentsOf(log);
}

/// Programs of the tests are recognised by their first lines, other texts are not.
TEST(VscodeExtension, ItKnowsAProgramByItsFirstLines) {
  const auto modules = nodeModules(extension);
  if (!modules)
    GTEST_SKIP() << "npm cannot fetch what the extension is built with";
  const TemporaryFolder temporary;
  std::vector<std::string> command = {"node", (temporary.path() / "ask.js").string()};
  std::string due;
  for (const auto &entry :
       fs::recursive_directory_iterator(fs::path(places::sourceFolder()) / "tests" / "programs"))
    if (entry.path().extension() == ".nc") {
      command.push_back(entry.path().string());
      due += "true " + entry.path().string() + "\n";
    }
  for (const char *text : notPrograms) {
    const fs::path file = temporary.path() / (std::to_string(command.size()) + ".txt");
    std::ofstream(file) << text;
    command.push_back(file.string());
    due += "false " + file.string() + "\n";
  }
  const fs::path log = temporary.path() / "log";
  ASSERT_NO_FATAL_FAILURE(compile(*modules, "program_text", temporary.path()));
  std::ofstream(command[1])
      << "const { looksLikeProgram } = require('./program_text.js');\n"
         "for (const file of process.argv.slice(2))\n"
         "  console.log(looksLikeProgram(require('fs').readFileSync(file, 'utf8')), file);\n";
  ASSERT_EQ(runOuter(command, log, 60), 0) << contentsOf(log);
  EXPECT_EQ(contentsOf(log), due);
}

/// The program is the one that the setting names, else the one in the extension, else that of PATH,
/// else the WebAssembly module of the extension.
TEST(VscodeExtension, ItFindsItsServer) {
  const auto modules = nodeModules(extension);
  if (!modules)
    GTEST_SKIP() << "npm cannot fetch what the extension is built with";
  const TemporaryFolder temporary;
  const fs::path &root = temporary.path();
  ASSERT_NO_FATAL_FAILURE(compile(*modules, "server_path", root));
  for (const char *folder : {"chosen", "full/bin", "path", "empty"}) {
    fs::create_directories(root / folder);
    const fs::path program = root / folder / "ncvet";
    std::ofstream(program) << "#!/bin/sh\n";
    if (folder != llvm::StringRef("empty")) // there it is no program
      fs::permissions(program, fs::perms::owner_exec, fs::perm_options::add);
  }
  std::ofstream(root / "ask.js")
      << "const { findServer } = require('./server_path.js');\n"
         "process.chdir(__dirname);\n"
         "const ask = (setting, extension, path) => {\n"
         "  process.env.PATH = path;\n"
         "  const { file, needsNode, lookedFor } = findServer(setting, extension);\n"
         "  console.log(file ? (needsNode ? 'node ' : '') + file : lookedFor);\n"
         "};\n"
         "ask('./chosen/ncvet', 'full', 'path');\n"
         "ask('', 'full', 'path');\n"
         "ask('', 'empty', 'empty:path');\n"
         "ask('ncvet', 'full', 'path');\n"
         "ask('./empty/ncvet', 'full', 'path');\n"
         "ask('', 'empty', 'empty');\n"
         "ask('', 'module', 'empty');\n"
         "ask('', 'module', 'path');\n";
  fs::create_directories(root / "module/server/bin");
  std::ofstream(root / "module/server/bin/ncvet.js") << "\n";
  const fs::path log = root / "log";
  ASSERT_EQ(runOuter({"node", (root / "ask.js").string()}, log, 60), 0) << contentsOf(log);
  EXPECT_EQ(contentsOf(log), "./chosen/ncvet\nfull/bin/ncvet\npath/ncvet\npath/ncvet\n"
                             "The setting ncvet.path names ./empty/ncvet, which is no program.\n"
                             "It is neither in the extension nor in PATH.\n"
                             "node module/server/bin/ncvet.js\n"
                             "path/ncvet\n");
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
  if (!nodeModules(extension))
    GTEST_SKIP() << "npm cannot fetch what the extension is built with: it is not packed";
  const TemporaryFolder temporary;
  const fs::path log = temporary.path() / "log";
  const auto packed = packExtension(temporary.path() / "package", log);
  ASSERT_TRUE(packed) << contentsOf(log);
  // The address of the project is not known yet; the packer has nothing else to say.
  const std::string said = contentsOf(log);
  EXPECT_EQ(llvm::StringRef(said).count("WARNING"), 1u) << said;
  EXPECT_THAT(said, testing::HasSubstr("A 'repository' field is missing"));
  const std::map<std::string, uint32_t> files = filesOfZip(contentsOf(*packed));
  EXPECT_EQ(files.count("extension/LICENSE.txt"), 1u);
  for (const char *file :
       {"CHANGELOG.md", "README.md", "package.json", "controls.json", "images/icon.png",
        "images/findings.png", "languages/parentheses.json", "schema/config.schema.json",
        "schema/machine.schema.json", "snippets/haas-mill.json", "syntaxes/gcode.tmLanguage.json",
        "walkthrough/control.md"})
    EXPECT_EQ(files.count(std::string("extension/") + file), 1u) << file;
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
  EXPECT_EQ(
      runOuter({"node", "-e", load, (packed->parent_path() / "dist" / "extension.js").string()},
               log, 60),
      0)
      << contentsOf(log);
}

/// Its bytes are compressed: that it is whole is seen by its size.
TEST(VscodeExtension, APackageForAPlatformHasTheProgramInIt) {
  if (!nodeModules(extension))
    GTEST_SKIP() << "npm cannot fetch what the extension is built with: it is not packed";
  const TemporaryFolder temporary;
  const fs::path log = temporary.path() / "log";
  const auto packed = packExtension(temporary.path() / "package", log, PackedServer::Program);
  ASSERT_TRUE(packed) << contentsOf(log);
  const std::map<std::string, uint32_t> files = filesOfZip(contentsOf(*packed));
  const auto program = files.find("extension/bin/ncvet");
  ASSERT_NE(program, files.end());
  EXPECT_EQ(program->second, fs::file_size(places::program()));
  EXPECT_EQ(files.count("extension/server/lib/ncvet.wasm"), 0u) << "nobody needs it there";
  const auto may = fs::status(packed->parent_path() / "bin" / "ncvet").permissions();
  EXPECT_EQ(may & fs::perms::others_exec, fs::perms::others_exec);
}

} // namespace
