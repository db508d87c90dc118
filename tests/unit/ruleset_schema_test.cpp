// The schemas of rulesets/: their vocabulary is the loader's, and every built-in table fits them.
#include "formats/dialect/action.h"
#include "formats/dialect/vocabulary.h"

#include "llvm/Support/MemoryBuffer.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

namespace ncvet {
namespace {

const std::string root = NCVET_SOURCE_DIR;

nlohmann::json schema(const std::string &name) {
  auto buffer = llvm::MemoryBuffer::getFile(root + "/rulesets/schema/" + name + ".schema.json");
  if (!buffer)
    return nullptr;
  return nlohmann::json::parse((*buffer)->getBuffer().begin(), (*buffer)->getBuffer().end(),
                               nullptr, false);
}

/// The names of an enumeration at `pointer`, which may also allow null.
std::vector<std::string> names(const nlohmann::json &schema, const std::string &pointer) {
  nlohmann::json::json_pointer at(pointer);
  if (!schema.contains(at))
    return {};
  nlohmann::json value = schema[at];
  if (value.contains("anyOf"))
    value = value["anyOf"][0];
  return value.value("enum", std::vector<std::string>());
}

std::vector<std::string> texts(llvm::ArrayRef<llvm::StringLiteral> list, size_t from = 0) {
  std::vector<std::string> copy;
  for (llvm::StringRef name : list.drop_front(from))
    copy.push_back(name.str());
  return copy;
}

TEST(Schemas, UseTheVocabularyOfTheLoader) {
  nlohmann::json dialect = schema("dialect");
  ASSERT_TRUE(dialect.is_object());
  EXPECT_EQ(names(dialect, "/$defs/action"), texts(actionNames()));
  EXPECT_EQ(names(dialect, "/$defs/severity"), texts(severityNames()));
  const std::string code = "/$defs/code/properties/", word = "/$defs/word/properties/";
  EXPECT_EQ(names(dialect, code + "cycle"), texts(cycleNames()));
  EXPECT_EQ(names(dialect, code + "spindle"), texts(spindleNames()));
  EXPECT_EQ(names(dialect, word + "role"), texts(roleNames()));
  EXPECT_EQ(names(dialect, word + "need"), texts(needNames()));
  EXPECT_EQ(names(dialect, word + "point"), texts(pointNames()));
  EXPECT_EQ(names(dialect, "/properties/machine"), texts(machineNames()));
  const nlohmann::json &address = dialect["properties"]["addresses"]["patternProperties"];
  ASSERT_EQ(address.size(), 1u);
  const nlohmann::json entry = address.begin().value()["anyOf"][0];
  EXPECT_EQ(names(entry, "/properties/kind"), texts(addressKindNames(), 1)) << "without `unknown`";
  EXPECT_EQ(names(entry, "/properties/unit"), texts(addressUnitNames()));
  EXPECT_EQ(names(entry, "/properties/axis"), texts(axisNames()));
}

TEST(Schemas, EveryBuiltinFileFitsItsSchema) {
  if (std::system("python3 -c 'import jsonschema' 2>/dev/null") != 0)
    GTEST_SKIP() << "needs Python's jsonschema";
  std::string program = R"(
import glob, json, sys
from jsonschema import Draft202012Validator as Validator
bad = 0
for kind, folder in (("dialect", "dialects"), ("machine", "machines")):
    schema = json.load(open(f"{sys.argv[1]}/schema/{kind}.schema.json", encoding="utf-8"))
    Validator.check_schema(schema)
    for path in sorted(glob.glob(f"{sys.argv[1]}/{folder}/*.json")):
        for error in Validator(schema).iter_errors(json.load(open(path, encoding="utf-8"))):
            print(path, list(error.absolute_path), error.message[:200])
            bad += 1
sys.exit(bad != 0)
)";
  std::string command = "python3 -c '" + program + "' '" + root + "/rulesets'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

} // namespace
} // namespace ncvet
