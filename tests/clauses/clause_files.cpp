#include "tests/clauses/clause_files.h"

#include "tests/support/places.h"

#include "llvm/ADT/StringSwitch.h"
#include "llvm/Support/MemoryBuffer.h"
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <set>

namespace ncvet::test {
namespace {

using Json = nlohmann::json;

llvm::Error failed(const std::string &where, const std::string &what) {
  return llvm::createStringError(llvm::inconvertibleErrorCode(), "%s: %s", where.c_str(),
                                 what.c_str());
}

llvm::Expected<Json> parsedFile(const std::string &path) {
  auto buffer = llvm::MemoryBuffer::getFile(path);
  if (!buffer)
    return failed(path, "cannot be read");
  const llvm::StringRef text = (*buffer)->getBuffer();
  Json value = Json::parse(text.begin(), text.end(), nullptr, false);
  if (value.is_discarded())
    return failed(path, "no JSON");
  return value;
}

/// Reads what `object` has under `key`; what is not there leaves `to` as it is.
template <typename Value>
llvm::Error read(const Json &object, const char *key, Value &to, const std::string &where) {
  const auto found = object.find(key);
  if (found == object.end())
    return llvm::Error::success();
  constexpr bool isText = std::is_same_v<Value, std::string>;
  constexpr bool isFlag = std::is_same_v<Value, bool>;
  const bool fits = isText   ? found->is_string()
                    : isFlag ? found->is_boolean()
                             : found->is_array() && llvm::all_of(*found, [](const Json &line) {
                                 return line.is_string();
                               });
  if (!fits)
    return failed(where, std::string(key) + " is of another kind");
  to = found->template get<Value>();
  return llvm::Error::success();
}

/// The keys of a clause beside those that its rule gives.
llvm::Error readClause(const Json &value, Clause &clause, const std::string &where) {
  static const std::set<std::string> keys = {"says", "dialect", "machine", "wrong",     "right",
                                             "also", "whole",   "missing", "falseAlarm"};
  if (!value.is_object() || !value.contains("says"))
    return failed(where, "a clause says something");
  for (const auto &entry : value.items())
    if (!keys.count(entry.key()))
      return failed(where, "no such key: " + entry.key());
  if (const auto machine = value.find("machine"); machine != value.end())
    clause.machine = machine->dump();
  for (auto &[key, text] : {std::pair("says", &clause.says),
                            {"dialect", &clause.dialect},
                            {"missing", &clause.missing},
                            {"falseAlarm", &clause.falseAlarm}})
    if (llvm::Error error = read(value, key, *text, where))
      return error;
  for (auto &[key, lines] :
       {std::pair("wrong", &clause.wrong), {"right", &clause.right}, {"also", &clause.also}})
    if (llvm::Error error = read(value, key, *lines, where))
      return error;
  return read(value, "whole", clause.whole, where);
}

llvm::Error readRule(const Json &value, Clause common, std::vector<Clause> &clauses,
                     const std::string &path) {
  if (!value.is_object() || !value.contains("local") || !value.contains("rule"))
    return failed(path, "an entry has `local` and `rule`");
  for (auto &[key, text] : {std::pair("local", &common.local), {"rule", &common.rule}})
    if (llvm::Error error = read(value, key, *text, path))
      return error;
  const std::string where = path + ": " + common.local;
  const auto list = value.find("clauses");
  if (list == value.end() || !list->is_array() || list->empty())
    return failed(where, "a rule has one clause or more");
  for (const Json &one : *list) {
    Clause clause = common;
    if (llvm::Error error = readClause(one, clause, where))
      return error;
    clauses.push_back(std::move(clause));
  }
  return llvm::Error::success();
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
  if (!file->is_array())
    return failed(path, "a list is due");
  for (const Json &rule : *file)
    if (llvm::Error error = readRule(rule, common, clauses, path))
      return error;
  return clauses;
}

std::vector<std::string> clauseFiles() {
  std::vector<std::string> files;
  for (const auto &category : std::filesystem::directory_iterator(
           std::filesystem::path(places::sourceFolder()) / "rules")) {
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
  static const Json frames =
      llvm::cantFail(parsedFile(places::sourceFolder() + "/tests/clauses/frames.json"));
  Frame frame;
  if (const auto object = frames.find(dialect.str()); object != frames.end()) {
    llvm::cantFail(read(*object, "file", frame.file, "frames.json"));
    llvm::cantFail(read(*object, "before", frame.before, "frames.json"));
    llvm::cantFail(read(*object, "after", frame.after, "frames.json"));
  }
  return frame;
}

} // namespace ncvet::test
