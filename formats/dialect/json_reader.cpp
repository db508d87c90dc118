// Typed reading of JSON values; the place of an error is looked for only when there is one.
#include "formats/dialect/json_reader.h"

#include "formats/dialect/vocabulary.h"

#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

#include <cmath>

namespace ncvet {

namespace {

/// Keeps the position and the text of the first syntax error.
class SyntaxErrorCatcher : public nlohmann::json_sax<Json> {
public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t &) override { return true; }
  bool string(string_t &) override { return true; }
  bool binary(binary_t &) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t &) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string &,
                   const nlohmann::detail::exception &error) override {
    position_ = position;
    // "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error …": the
    // library's own prefix and place are replaced by ours.
    llvm::StringRef what = error.what();
    size_t cut = what.find(": ");
    reason_ = (cut == llvm::StringRef::npos ? what : what.drop_front(cut + 2)).str();
    return false;
  }
  size_t position() const { return position_; }
  const std::string &reason() const { return reason_; }

private:
  size_t position_ = 0;
  std::string reason_;
};

void dropNulls(Json &value) {
  if (!value.is_object())
    return;
  for (auto entry = value.begin(); entry != value.end();) {
    if (entry->is_null()) {
      entry = value.erase(entry);
    } else {
      dropNulls(*entry);
      ++entry;
    }
  }
}

/// Finds the value by its address: values know no parents.
bool findPath(const Json &from, const Json &wanted, JsonPath &path) {
  if (&from == &wanted)
    return true;
  if (!from.is_structured())
    return false;
  size_t index = 0;
  for (auto entry = from.begin(); entry != from.end(); ++entry, ++index) {
    JsonStep step;
    step.isIndex = from.is_array();
    step.index = index;
    if (!step.isIndex)
      step.key = entry.key();
    path.push_back(std::move(step));
    if (findPath(*entry, wanted, path))
      return true;
    path.pop_back();
  }
  return false;
}

/// A machine profile may write "M8" for the table's "M08".
JsonPath withShortCode(JsonPath path) {
  if (path.size() > 1 && path[0].key == "codes" && path[1].key.size() > 2 && path[1].key[1] == '0')
    path[1].key.erase(1, 1);
  return path;
}

std::string join(llvm::ArrayRef<llvm::StringRef> names) {
  std::string text;
  for (llvm::StringRef name : names)
    text += (text.empty() ? "" : ", ") + name.str();
  return text;
}

} // namespace

llvm::Expected<Json> parseJson(llvm::StringRef name, llvm::StringRef text) {
  if (nestsTooDeep(text))
    return llvm::createStringError(std::errc::invalid_argument, "%s: brackets nest too deep",
                                   name.str().c_str());
  Json json = Json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions=*/false,
                          /*ignore_comments=*/true);
  if (!json.is_discarded())
    return json;
  SyntaxErrorCatcher catcher;
  Json::sax_parse(text.begin(), text.end(), &catcher, Json::input_format_t::json, /*strict=*/true,
                  /*ignore_comments=*/true);
  return llvm::createStringError(std::errc::invalid_argument, "%s:%u: %s", name.str().c_str(),
                                 lineAt(text, catcher.position()), catcher.reason().c_str());
}

llvm::Error refuseRepeatedKeys(llvm::StringRef name, llvm::StringRef text) {
  const std::optional<size_t> offset = findRepeatedKey(text);
  if (!offset)
    return llvm::Error::success();
  const llvm::StringRef key = text.drop_front(*offset + 1).split('"').first;
  return llvm::createStringError(std::errc::invalid_argument, "%s:%u: %s: the key is here twice",
                                 name.str().c_str(), lineAt(text, *offset), key.str().c_str());
}

void layOver(Json &base, Json &&over) {
  if (!over.is_object() || !base.is_object()) {
    dropNulls(over);
    base = std::move(over);
    return;
  }
  for (auto entry = over.begin(); entry != over.end(); ++entry) {
    if (entry->is_null())
      base.erase(entry.key());
    else
      layOver(base[entry.key()], std::move(*entry));
  }
}

std::string suggest(llvm::StringRef given, llvm::ArrayRef<llvm::StringRef> known) {
  llvm::StringRef nearest;
  unsigned best = unsigned(given.size() / 3 + 1);
  for (llvm::StringRef name : known) {
    unsigned distance = given.edit_distance(name, /*AllowReplacements=*/true, best);
    if (distance <= best && distance < given.size() && (nearest.empty() || distance < best)) {
      best = distance;
      nearest = name;
    }
  }
  if (!nearest.empty())
    return "; did you mean \"" + nearest.str() + "\"?";
  return "; one of " + join(known);
}

void JsonReader::setOverlay(const Json *overlay, JsonPath path) {
  overlay_ = overlay;
  overlayPath_ = std::move(path);
}

JsonPath JsonReader::pathOf(const Json &at) const {
  JsonPath path;
  if (overlay_) {
    path = overlayPath_;
    if (findPath(*overlay_, at, path))
      return path;
    path.clear();
  }
  if (!findPath(*root_, at, path))
    path.clear();
  return path;
}

std::string JsonReader::placeOf(JsonPath path) const {
  // The most derived file that holds the place wins. What a variant inherits is in its code;
  // what nothing holds is in the nearest enclosing value.
  while (true) {
    for (size_t index = layers_.size(); index-- > 0;)
      for (const JsonPath &way : {path, withShortCode(path)})
        if (std::optional<size_t> offset = findJsonPlace(layers_[index].text, way))
          return layers_[index].name + ":" + std::to_string(lineAt(layers_[index].text, *offset));
    if (path.empty())
      return layers_.empty() ? std::string() : layers_.back().name + ":1";
    if (!overlayPath_.empty() && path.size() > overlayPath_.size() && path.size() >= 4 &&
        path[2].key == "variants") {
      path.erase(path.begin() + 2, path.begin() + 4);
      continue;
    }
    path.pop_back();
  }
}

void JsonReader::fail(const Json &at, const llvm::Twine &message) {
  if (failed())
    return;
  JsonPath path = pathOf(at);
  message_ = placeOf(path) + ": ";
  if (!path.empty())
    message_ += toString(path) + ": ";
  message_ += message.str();
}

llvm::Error JsonReader::takeError() {
  if (!failed())
    return llvm::Error::success();
  return llvm::createStringError(std::errc::invalid_argument, "%s", message_.c_str());
}

bool JsonReader::isObject(const Json &value) {
  if (value.is_object())
    return true;
  fail(value, "an object { … } is expected");
  return false;
}

void JsonReader::allowKeys(const Json &object, llvm::ArrayRef<llvm::StringRef> keys) {
  if (failed() || !isObject(object))
    return;
  for (auto entry = object.begin(); entry != object.end(); ++entry)
    if (!llvm::is_contained(keys, llvm::StringRef(entry.key())))
      return fail(*entry, "unknown key" + suggest(entry.key(), keys));
}

const Json *JsonReader::member(const Json &object, const char *key) const {
  if (!object.is_object())
    return nullptr;
  auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

std::optional<std::string> JsonReader::text(const Json &value) {
  if (value.is_string())
    return value.get_ref<const std::string &>();
  fail(value, "a string is expected");
  return std::nullopt;
}

std::optional<double> JsonReader::number(const Json &value) {
  if (value.is_number())
    return value.get<double>();
  fail(value, "a number is expected");
  return std::nullopt;
}

std::optional<bool> JsonReader::flag(const Json &value) {
  if (value.is_boolean())
    return value.get<bool>();
  fail(value, "true or false is expected");
  return std::nullopt;
}

std::optional<long> JsonReader::whole(const Json *value, long least, long most) {
  if (!value)
    return std::nullopt;
  double found = value->is_number() ? value->get<double>() : std::nan("");
  if (found >= double(least) && found <= double(most) && std::floor(found) == found)
    return long(found);
  fail(*value,
       "a whole number from " + llvm::Twine(least) + " to " + llvm::Twine(most) + " is expected");
  return std::nullopt;
}

std::optional<size_t> JsonReader::choice(const Json *value, const char *what,
                                         llvm::ArrayRef<llvm::StringLiteral> names) {
  std::optional<std::string> given = value ? text(*value) : std::nullopt;
  if (!given)
    return std::nullopt;
  for (size_t index = 0; index < names.size(); ++index)
    if (names[index] == *given)
      return index;
  std::vector<llvm::StringRef> known(names.begin(), names.end());
  fail(*value, llvm::Twine("unknown ") + what + " \"" + *given + "\"" + suggest(*given, known));
  return std::nullopt;
}

std::vector<std::string> JsonReader::texts(const Json &value) {
  std::vector<std::string> list;
  if (value.is_string())
    return {value.get<std::string>()};
  if (!value.is_array()) {
    fail(value, "a string or a list of strings is expected");
    return list;
  }
  for (const Json &element : value)
    if (std::optional<std::string> one = text(element))
      list.push_back(*one);
  return list;
}

void JsonReader::read(const Json &object, const char *key, std::string &target) {
  if (const Json *value = member(object, key))
    if (std::optional<std::string> given = text(*value))
      target = *given;
}

void JsonReader::read(const Json &object, const char *key, bool &target) {
  if (const Json *value = member(object, key))
    if (const std::optional<bool> given = flag(*value))
      target = *given;
}

void JsonReader::read(const Json &object, const char *key, double &target) {
  if (const Json *value = member(object, key))
    if (std::optional<double> given = number(*value))
      target = *given;
}

void JsonReader::read(const Json &object, const char *key, std::optional<double> &target) {
  if (const Json *value = member(object, key))
    target = number(*value);
}

void JsonReader::read(const Json &object, const char *key, std::optional<Severity> &target) {
  if (std::optional<size_t> index = choice(member(object, key), "severity", severityNames()))
    target = Severity(*index);
}

} // namespace ncvet
