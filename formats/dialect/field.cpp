// Reads the values of fields, and writes what a fresh struct holds.
#include "formats/dialect/field.h"

#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

namespace ncvet {

namespace {

/// More keys than any object has, those of a record's base included.
constexpr size_t maxFields = 64;

/// Where a key is among the fields; their number when it is not there.
size_t indexOf(llvm::ArrayRef<Field> fields, llvm::StringRef key) {
  size_t index = 0;
  while (index < fields.size() && fields[index].key != key)
    ++index;
  return index;
}

std::vector<llvm::StringRef> keysOf(const Record &record) {
  std::vector<llvm::StringRef> keys;
  for (const Record *part = &record; part; part = part->base)
    for (const Field &field : part->fields)
      keys.push_back(field.key);
  return keys;
}

/// How many elements a list has, for a message.
std::string lengthOf(const Shape &shape) {
  if (!shape.fewest && !shape.many)
    return {};
  const llvm::Twine fewest(shape.fewest);
  if (shape.fewest == shape.many)
    return (" of " + fewest).str();
  if (shape.many)
    return (" of " + fewest + " to " + llvm::Twine(shape.many)).str();
  return (" of at least " + fewest).str();
}

} // namespace

bool isFieldOf(const Record &record, llvm::StringRef key) {
  return indexOf(record.fields, key) < record.fields.size();
}

void readRecord(JsonReader &in, const Json &object, const Record &record, void *target) {
  if (in.failed() || !in.isObject(object))
    return;
  const llvm::ArrayRef<Field> fields = record.fields;
  assert(fields.size() <= maxFields && "a record has too many keys");
  std::array<const Json *, maxFields> found{};
  for (auto entry = object.begin(); entry != object.end(); ++entry) {
    const size_t index = indexOf(fields, entry.key());
    if (index < fields.size())
      found[index] = &*entry;
    else if (!record.others)
      return in.fail(*entry, "unknown key" + suggest(entry.key(), keysOf(record)));
  }
  for (size_t i = 0; i < fields.size(); ++i) {
    if (found[i] && fields[i].read)
      fields[i].read(in, fields[i].shape, *found[i], target);
    else if (!found[i] && fields[i].required)
      in.fail(object, "the key \"" + fields[i].key + "\" is missing");
  }
  if (record.finish && !in.failed())
    record.finish(in, object, target);
}

void readValue(JsonReader &in, const Shape &, const Json &value, std::string &target) {
  if (auto text = in.text(value))
    target = std::move(*text);
}

void readValue(JsonReader &in, const Shape &shape, const Json &value, bool &target) {
  if (shape.names) {
    if (const auto index = in.choice(&value, shape.what, shape.names()))
      target = *index != 0;
  } else if (const auto flag = in.flag(value))
    target = *flag;
}

void readValue(JsonReader &in, const Shape &shape, const Json &value, double &target) {
  const auto number = in.number(value);
  if (!number)
    return;
  if (*number < shape.least || *number > shape.most)
    return in.fail(value, shape.least == 0 ? llvm::Twine("a number not below 0 is expected")
                                           : llvm::Twine("the number is out of its range"));
  target = *number;
}

void readValue(JsonReader &in, const Shape &, const Json &value, std::vector<std::string> &target) {
  target = in.texts(value);
}

std::vector<const Json *> readList(JsonReader &in, const Shape &shape, const Json &value) {
  std::vector<const Json *> elements;
  if (!value.is_array() || value.size() < shape.fewest ||
      (shape.many && value.size() > shape.many)) {
    in.fail(value, "a list is expected" + lengthOf(shape));
    return elements;
  }
  for (const Json &element : value)
    elements.push_back(&element);
  return elements;
}

std::optional<long> readIndex(JsonReader &in, const Shape &shape, const Json &value) {
  if (shape.form == Form::Whole)
    return in.whole(&value, long(shape.least), long(shape.most));
  if (const auto index = in.choice(&value, shape.what, shape.names()))
    return long(*index);
  return std::nullopt;
}

std::string jsonOf(const Shape &, const std::string &value) {
  return value.empty() ? std::string() : Json(value).dump();
}

std::string jsonOf(const Shape &shape, bool value) {
  return shape.names ? nameOf(shape, value) : value ? "true" : "false";
}

std::string jsonOf(const Shape &, double value) {
  return std::isfinite(value) ? Json(value).dump() : std::string();
}

std::string nameOf(const Shape &shape, long value) {
  if (!shape.names)
    return std::to_string(value);
  const Names names = shape.names();
  if (size_t(value) >= names.size() || size_t(value) < shape.firstName)
    return {};
  return Json(names[size_t(value)].str()).dump();
}

} // namespace ncvet
