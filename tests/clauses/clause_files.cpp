#include "tests/clauses/clause_files.h"

#include "llvm/ADT/StringSwitch.h"
#include "llvm/Support/FormatVariadic.h"
#include "llvm/Support/JSON.h"
#include "llvm/Support/MemoryBuffer.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace ncvet::test {
namespace {

namespace json = llvm::json;

llvm::Expected<json::Value> parsedFile(const std::string &path) {
  auto buffer = llvm::MemoryBuffer::getFile(path);
  if (!buffer)
    return llvm::createStringError(buffer.getError(), "%s: cannot be read", path.c_str());
  auto value = json::parse((*buffer)->getBuffer());
  if (!value)
    return llvm::createStringError(llvm::inconvertibleErrorCode(), "%s: %s", path.c_str(),
                                   llvm::toString(value.takeError()).c_str());
  return value;
}

bool fromLines(const json::Object &object, llvm::StringRef key, std::vector<std::string> &lines,
               json::Path path) {
  const json::Value *value = object.get(key);
  return !value || fromJSON(*value, lines, path.field(key));
}

/// The keys of a clause beside those that its rule gives.
bool readClause(const json::Value &value, Clause &clause, json::Path path) {
  json::ObjectMapper map(value, path);
  if (!map || !map.map("says", clause.says) || !map.mapOptional("dialect", clause.dialect) ||
      !map.mapOptional("whole", clause.whole) || !map.mapOptional("missing", clause.missing) ||
      !map.mapOptional("falseAlarm", clause.falseAlarm))
    return false;
  const json::Object &object = *value.getAsObject();
  static const std::set<llvm::StringRef> keys = {"says", "dialect", "machine", "wrong",     "right",
                                                 "also", "whole",   "missing", "falseAlarm"};
  for (const auto &[key, unused] : object)
    if (!keys.count(key)) {
      path.field(key).report("no such key");
      return false;
    }
  if (const json::Value *machine = object.get("machine"))
    clause.machine = llvm::formatv("{0}", *machine);
  return fromLines(object, "wrong", clause.wrong, path) &&
         fromLines(object, "right", clause.right, path) &&
         fromLines(object, "also", clause.also, path);
}

bool readRule(const json::Value &value, Clause common, std::vector<Clause> &clauses,
              json::Path path) {
  json::ObjectMapper map(value, path);
  if (!map || !map.map("local", common.local) || !map.map("rule", common.rule))
    return false;
  const json::Array *list = value.getAsObject()->getArray("clauses");
  if (!list || list->empty()) {
    path.field("clauses").report("a rule has one clause or more");
    return false;
  }
  for (size_t i = 0; i < list->size(); ++i) {
    Clause clause = common;
    if (!readClause((*list)[i], clause, path.field("clauses").index(unsigned(i))))
      return false;
    clauses.push_back(std::move(clause));
  }
  return true;
}

/// The table that a reference's programs are checked with, unless they name one.
std::string dialectOf(llvm::StringRef reference) {
  return llvm::StringSwitch<llvm::StringRef>(reference)
      .Case("fanuc-nct", "fanuc-0t")
      .Case("ecs-cycles", "ecs")
      .Case("fanuc-i", "fanuc-mill")
      .Case("haas-ngc", "haas-mill")
      .Case("sinumerik-840d", "sinumerik")
      .Default(reference)
      .str();
}

} // namespace

llvm::Expected<std::vector<Clause>> readClauses(const std::string &path) {
  auto file = parsedFile(path);
  if (!file)
    return file.takeError();
  Clause common;
  const std::filesystem::path place(path);
  common.reference = place.stem().string();
  common.category = place.parent_path().parent_path().filename().string();
  common.dialect = dialectOf(common.reference);
  std::vector<Clause> clauses;
  json::Path::Root root(path);
  const json::Array *rules = file->getAsArray();
  if (!rules)
    return llvm::createStringError(llvm::inconvertibleErrorCode(), "%s: a list is due",
                                   path.c_str());
  for (size_t i = 0; i < rules->size(); ++i)
    if (!readRule((*rules)[i], common, clauses, json::Path(root).index(unsigned(i))))
      return root.getError();
  return clauses;
}

std::vector<std::string> clauseFiles() {
  std::vector<std::string> files;
  for (const auto &category :
       std::filesystem::directory_iterator(std::filesystem::path(NCVET_SOURCE_DIR) / "rules")) {
    const std::filesystem::path folder = category.path() / "clauses";
    if (!std::filesystem::is_directory(folder))
      continue;
    for (const auto &file : std::filesystem::directory_iterator(folder))
      files.push_back(file.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Frame frameOf(llvm::StringRef dialect) {
  static const json::Value frames =
      llvm::cantFail(parsedFile(std::string(NCVET_SOURCE_DIR) + "/tests/clauses/frames.json"));
  Frame frame;
  const json::Object *object = frames.getAsObject()->getObject(dialect);
  json::Path::Root root("frames.json");
  if (object) {
    frame.file = object->getString("file").getValueOr(frame.file).str();
    fromLines(*object, "before", frame.before, root);
    fromLines(*object, "after", frame.after, root);
  }
  return frame;
}

} // namespace ncvet::test
