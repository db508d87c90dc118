// Typed reading of JSON values with errors that name file, line and what was expected there.
#pragma once

#include "formats/dialect/json_place.h"
#include "formats/finding/finding.h"

#include "llvm/Support/Error.h"
#include <nlohmann/json_fwd.hpp>

namespace ncvet {

using Json = nlohmann::json;

/// A file that took part in a merged document.
struct JsonLayer {
  std::string name; ///< for messages
  llvm::StringRef text;
};

/// Parses one file; a syntax error names its line. Comments, as C++ has them, count as blanks.
llvm::Expected<Json> parseJson(llvm::StringRef name, llvm::StringRef text);

/// An error that names the line when an object has a key twice: only one of them would count.
llvm::Error refuseRepeatedKeys(llvm::StringRef name, llvm::StringRef text);

/// `over` laid over `base`: objects merge key by key, null removes, everything else replaces.
void layOver(Json &base, Json &&over);

/// ` (did you mean "…"?)` or, when nothing is near, `; one of …`.
std::string suggest(llvm::StringRef given, llvm::ArrayRef<llvm::StringRef> known);

/// Reads members of objects. The first error is kept, later ones are dropped: after an error every
/// reader goes on with defaults, and the owner asks `takeError` at the end.
class JsonReader {
public:
  /// Layers from base to the most derived; the root must outlive the reader and not change.
  JsonReader(llvm::ArrayRef<JsonLayer> layers, const Json &root) : layers_(layers), root_(&root) {}

  /// Values of `overlay` are reported as if they were at `path` of the document; null ends it.
  void setOverlay(const Json *overlay, JsonPath path = {});

  void fail(const Json &at, const llvm::Twine &message);
  bool failed() const { return !message_.empty(); }
  llvm::Error takeError();

  /// False and an error when it is not an object.
  bool isObject(const Json &value);
  void allowKeys(const Json &object, llvm::ArrayRef<llvm::StringRef> keys);
  const Json *member(const Json &object, const char *key) const;

  /// Each leaves the target as it is when the key is absent.
  void read(const Json &object, const char *key, std::string &target);
  void read(const Json &object, const char *key, bool &target);
  void read(const Json &object, const char *key, double &target);
  void read(const Json &object, const char *key, std::optional<double> &target);
  void read(const Json &object, const char *key, std::optional<Severity> &target);
  template <typename Integer>
  void readWhole(const Json &object, const char *key, Integer &target, long least, long most) {
    if (std::optional<long> value = whole(member(object, key), least, most))
      target = Integer(*value);
  }
  std::optional<std::string> text(const Json &value);
  std::optional<double> number(const Json &value);
  std::optional<bool> flag(const Json &value);
  std::optional<long> whole(const Json *value, long least, long most);
  std::optional<size_t> choice(const Json *value, const char *what,
                               llvm::ArrayRef<llvm::StringLiteral> names);
  /// A string or a list of strings.
  std::vector<std::string> texts(const Json &value);

private:
  JsonPath pathOf(const Json &at) const;
  std::string placeOf(JsonPath path) const;

  llvm::ArrayRef<JsonLayer> layers_;
  const Json *root_;
  const Json *overlay_ = nullptr;
  JsonPath overlayPath_;
  std::string message_;
};

} // namespace ncvet
