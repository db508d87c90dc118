// What is made of the tables' records: schemas and reference are the newest, and all files fit
// them.
#include "formats/dialect/config_file.h"
#include "formats/dialect/loader.h"
#include "formats/dialect/stored_names.h"
#include "formats/schema/generated_files.h"
#include "tests/support/places.h"

#include "llvm/Support/MemoryBuffer.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <set>

namespace ncvet {
namespace {

const std::string root = places::sourceFolder() + "/rulesets/";

std::string contentOf(const std::string &name) {
  auto buffer = llvm::MemoryBuffer::getFile(root + name);
  return buffer ? (*buffer)->getBuffer().str() : std::string();
}

/// The roots and all records that their fields name.
std::vector<const Record *> allRecords() {
  std::vector<const Record *> records = {&dialectRecord, &machineRecord, &configRecord,
                                         &profileRecord, &detectRecord};
  const auto add = [&](const Shape *shape) {
    for (; shape; shape = shape->of ? shape->of : shape->otherwise)
      if (shape->record &&
          std::find(records.begin(), records.end(), shape->record) == records.end())
        records.push_back(shape->record);
  };
  for (size_t at = 0; at < records.size(); ++at)
    for (const Field &field : records[at]->fields) {
      add(&field.shape);
      add(field.shape.otherwise);
      add(field.shape.of ? field.shape.of->otherwise : nullptr);
    }
  return records;
}

TEST(GeneratedTableFiles, AreWhatTheRecordsMakeOfThem) {
  for (const GeneratedFile &file : generatedFiles())
    EXPECT_TRUE(contentOf(file.name) == file.text)
        << "rulesets/" << file.name << " is not the newest: run ./dev schema";
}

TEST(TableRecords, EveryKeyHasAMeaningAndAnExampleThatIsJson) {
  EXPECT_GT(allRecords().size(), 30u);
  for (const Record *record : allRecords()) {
    std::set<std::string> keys;
    for (const Field &field : record->fields) {
      const std::string name = record->name.str() + "." + field.key.str();
      EXPECT_TRUE(keys.insert(field.key.str()).second) << name << " is there twice";
      EXPECT_GE(field.meaning.size(), 2u) << name;
      EXPECT_FALSE(field.meaning.endswith(".")) << name;
      if (!field.example.empty())
        EXPECT_FALSE(nlohmann::json::parse(field.example.str(), nullptr, false).is_discarded())
            << name;
      else
        EXPECT_NE(field.shape.form, Form::Flag) << name << " needs an example";
    }
  }
}

TEST(TableRecords, KnowEveryOptionThatADialectHas) {
  std::set<std::string> used;
  for (const DialectSummary &summary : listDialects()) {
    auto dialect = loadDialect(summary.id, builtinDialects());
    ASSERT_TRUE(bool(dialect)) << llvm::toString(dialect.takeError());
    for (const auto &option : (*dialect)->options) {
      EXPECT_TRUE(isFieldOf(machineOptionRecord, option.getKey()))
          << summary.id << " has the option " << option.getKey().str()
          << ", which formats/dialect/machine_options.cpp does not describe";
      used.insert(option.getKey().str());
    }
  }
  for (const Field &field : machineOptionRecord.fields)
    EXPECT_TRUE(used.count(field.key.str())) << field.key.str() << " is no dialect's option";
}

/// Where the radius of compensation comes from.
std::string radiusOf(const nlohmann::json &dialect) {
  return dialect.contains("toolRadius") ? dialect["toolRadius"].value("variable", std::string())
                                        : "";
}

TEST(StoredNames, EveryNameThatACodeLeavesIsReadSomewhere) {
  std::set<std::string> declared;
  for (const StoredNameInfo &info : storedNames())
    declared.insert(info.name.str());
  for (const RulesetFile &file : builtinRulesetFiles()) {
    if (!file.name.startswith("dialects/"))
      continue;
    const auto json =
        nlohmann::json::parse(file.text.begin(), file.text.end(), nullptr, /*exceptions=*/false);
    if (!json.contains("codes"))
      continue;
    for (const auto &[name, code] : json["codes"].items()) {
      if (!code.contains("stores"))
        continue;
      for (const auto &[stored, value] : code["stores"].items()) {
        if (stored.front() == '_' && !declared.count(stored)) {
          EXPECT_TRUE(file.text.contains("$" + stored) || file.text.contains("@" + stored) ||
                      radiusOf(json).find(stored) != std::string::npos)
              << file.name.str() << ": " << name << " leaves " << stored << ", which nothing reads";
        }
      }
    }
  }
}

/// Checks all built-in files, and the examples in the schemas themselves.
constexpr const char *fitsProgram = R"(
import glob, json, sys
from jsonschema import Draft202012Validator as Validator
bad = []
def examples(schema, part, place):
    if isinstance(part, list):
        for i, item in enumerate(part):
            examples(schema, item, place + [i])
    elif isinstance(part, dict):
        if isinstance(part.get("examples"), list):
            for example in part["examples"]:
                for error in Validator(dict(part, **{"$defs": schema["$defs"]})).iter_errors(example):
                    bad.append((place, error.message))
        for key, item in part.items():
            examples(schema, item, place + [key])
for kind, files in (("dialect", "dialects/*"), ("machine", "machines/*"), ("profile", "profiles/*"),
                    ("detect", "detect"), ("config", "no configuration is built in")):
    schema = json.load(open(f"{sys.argv[1]}schema/{kind}.schema.json", encoding="utf-8"))
    Validator.check_schema(schema)
    examples(schema, schema, [kind])
    for path in sorted(glob.glob(f"{sys.argv[1]}{files}.json")):
        for error in Validator(schema).iter_errors(json.load(open(path, encoding="utf-8"))):
            bad.append((path, list(error.absolute_path), error.message[:200]))
for item in bad:
    print(*item)
sys.exit(bool(bad))
)";

TEST(Schemas, EveryBuiltinFileAndEveryExampleFits) {
  if (std::system("python3 -c 'import jsonschema' 2>/dev/null") != 0)
    GTEST_SKIP() << "needs Python's jsonschema";
  const std::string command = std::string("python3 -c '") + fitsProgram + "' '" + root + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

/// The texts of the fenced JSON blocks of a page.
std::vector<std::string> fencedJson(llvm::StringRef page) {
  std::vector<std::string> blocks;
  while (page.contains("```json\n")) {
    page = page.split("```json\n").second;
    blocks.push_back(page.split("```").first.str());
  }
  return blocks;
}

TEST(TablesReadme, ItsExamplesLoad) {
  const std::vector<std::string> examples = fencedJson(contentOf("README.md"));
  ASSERT_EQ(examples.size(), 3u) << "a code, a control, a machine";
  for (const std::string &text : examples) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    ASSERT_TRUE(json.is_object()) << text;
    if (json.contains("id")) {
      const auto id = json["id"].get<std::string>();
      const DialectSource builtin = builtinDialects();
      auto dialect = loadDialect(
          id,
          [&](llvm::StringRef wanted) -> std::optional<std::pair<std::string, llvm::StringRef>> {
            if (wanted == id)
              return std::pair(std::string("README.md"), llvm::StringRef(text));
            return builtin(wanted);
          });
      EXPECT_TRUE(bool(dialect)) << llvm::toString(dialect.takeError());
      continue;
    }
    auto dialect = loadDialect(json["dialect"].get<std::string>(), builtinDialects());
    ASSERT_TRUE(bool(dialect)) << llvm::toString(dialect.takeError());
    auto changed = overlay(*dialect, "README.md", text);
    EXPECT_TRUE(bool(changed)) << llvm::toString(changed.takeError());
    auto profile = parseMachineProfile("README.md", text);
    EXPECT_TRUE(bool(profile)) << llvm::toString(profile.takeError());
  }
}

} // namespace
} // namespace ncvet
