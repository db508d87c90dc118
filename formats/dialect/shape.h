// What a table may hold: the forms of its values, the keys of its objects, and what each is for.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <limits>
#include <string>

namespace ncvet {

class JsonReader;
struct Record;

/// How a value is written in JSON.
enum class Form : uint8_t {
  Text,
  Flag, ///< true or false
  Number,
  Whole,     ///< a number without decimals
  Name,      ///< one of the names of a vocabulary
  Texts,     ///< a string or a list of strings
  Addresses, ///< a set of addresses: letters in one string, or a list of names
  Formula,
  Scalar, ///< true or false, a number or a string
  List,
  Map,   ///< an object whose keys the table chooses
  Object ///< an object with the keys of a `Record`
};

using Names = llvm::ArrayRef<llvm::StringLiteral>;

/// The form of a value with its bounds, names or elements.
struct Shape {
  Form form = Form::Text;
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  size_t fewest = 0, many = 0;      ///< elements of a list; `many` 0: not limited
  const char *what = "";            ///< one of the names, for messages: "role"
  Names (*names)() = nullptr;       ///< of a name, or of the keys of a map
  size_t firstName = 0;             ///< names before this one are not written
  const char *pattern = nullptr;    ///< regular expression of a text, or of the keys of a map
  const Shape *of = nullptr;        ///< elements of a list, values of a map
  const Record *record = nullptr;   ///< of an object
  const Shape *otherwise = nullptr; ///< a second form that is allowed
};

/// One key of an object: the only place in which it is written down. The reader, the JSON Schema
/// and the reference are made of it.
struct Field {
  llvm::StringLiteral key;
  Shape shape;
  llvm::StringLiteral meaning;      ///< one sentence for the reference and the schema
  llvm::StringLiteral example = ""; ///< a value as JSON
  bool required = false;
  bool own = false; ///< of each file itself: what extends it does not inherit it
  /// Reads the value into the member of the record's struct; null: somebody else reads it.
  void (*read)(JsonReader &in, const Shape &shape, const nlohmann::json &value,
               void *target) = nullptr;
  /// The value of the member in a fresh struct, as JSON; null or empty: nothing.
  std::string (*fallback)(const Shape &shape, const void *defaults) = nullptr;

  /// The same key, which is not inherited.
  constexpr Field ofEachFile() const {
    Field copy = *this;
    copy.own = true;
    return copy;
  }
  /// The same key, which must be there.
  constexpr Field mustBeThere() const {
    Field copy = *this;
    copy.required = true;
    return copy;
  }
};

/// An object with fixed keys.
struct Record {
  llvm::StringLiteral name; ///< "code": in the schema and in the reference
  llvm::StringLiteral meaning;
  llvm::ArrayRef<Field> fields;
  /// Objects of this record are laid over one another: null takes an inherited key away.
  bool laidOver = false;
  const Record *base = nullptr;  ///< it may have the keys of this record too
  const Shape *others = nullptr; ///< form of the values of further keys; null: there are none
  const void *(*defaults)() = nullptr;
  /// What is to be said of the object as a whole, after its keys.
  void (*finish)(JsonReader &in, const nlohmann::json &object, void *target) = nullptr;
};

/// The record of a struct.
template <typename T>
struct RecordOf : Record {
  constexpr RecordOf(llvm::StringLiteral called, llvm::StringLiteral what,
                     llvm::ArrayRef<Field> keys)
      : Record{called, what, keys} {
    defaults = []() -> const void * {
      static const T value{};
      return &value;
    };
  }
  /// Null takes an inherited key away.
  constexpr RecordOf overlay() const {
    RecordOf copy = *this;
    copy.laidOver = true;
    return copy;
  }
  constexpr RecordOf with(const Shape &further) const {
    RecordOf copy = *this;
    copy.others = &further;
    return copy;
  }
  constexpr RecordOf basedOn(const Record &other) const {
    RecordOf copy = *this;
    copy.base = &other;
    return copy;
  }
  /// With a look at the whole object after its keys were read.
  template <auto Check>
  constexpr RecordOf checkedBy() const {
    RecordOf copy = *this;
    copy.finish = [](JsonReader &in, const nlohmann::json &object, void *target) {
      Check(in, object, *static_cast<T *>(target));
    };
    return copy;
  }
};

/// Reads the keys that the object has, in the order of the record. An unknown key and a missing one
/// that must be there are errors.
void readRecord(JsonReader &in, const nlohmann::json &object, const Record &record, void *target);
/// Whether the record has a key of this name.
bool isFieldOf(const Record &record, llvm::StringRef key);
template <typename T>
void readInto(JsonReader &in, const nlohmann::json &object, const RecordOf<T> &record, T &target) {
  readRecord(in, object, record, &target);
}

namespace shape {
constexpr Shape text{Form::Text};
constexpr Shape boolean{Form::Flag};
constexpr Shape number{Form::Number};
constexpr Shape texts{Form::Texts};
constexpr Shape addresses{Form::Addresses};
constexpr Shape formula{Form::Formula};
constexpr Shape scalar{Form::Scalar};

constexpr Shape numberFrom(double least, double most = std::numeric_limits<double>::infinity()) {
  Shape shape{Form::Number};
  shape.least = least;
  shape.most = most;
  return shape;
}
constexpr Shape whole(double least, double most) {
  Shape shape{Form::Whole};
  shape.least = least;
  shape.most = most;
  return shape;
}
/// How many of something, or the number of a variable.
constexpr Shape wholeNumber = whole(0, 999999);
/// One of `names`, which messages call a `what`.
constexpr Shape name(const char *what, Names (*names)(), size_t first = 0) {
  Shape shape{Form::Name};
  shape.what = what;
  shape.names = names;
  shape.firstName = first;
  return shape;
}
constexpr Shape textLike(const char *pattern) {
  Shape shape{Form::Text};
  shape.pattern = pattern;
  return shape;
}
constexpr Shape object(const Record &record) {
  Shape shape{Form::Object};
  shape.record = &record;
  return shape;
}
constexpr Shape listOf(const Shape &of, size_t fewest = 0, size_t many = 0) {
  Shape shape{Form::List};
  shape.of = &of;
  shape.fewest = fewest;
  shape.many = many;
  return shape;
}
constexpr Shape mapOf(const Shape &of, const char *pattern = nullptr) {
  Shape shape{Form::Map};
  shape.of = &of;
  shape.pattern = pattern;
  return shape;
}
/// A map whose keys are names of a vocabulary.
constexpr Shape mapByName(const Shape &of, const char *what, Names (*names)()) {
  Shape shape{Form::Map};
  shape.of = &of;
  shape.what = what;
  shape.names = names;
  return shape;
}
constexpr Shape either(Shape shape, const Shape &otherwise) {
  shape.otherwise = &otherwise;
  return shape;
}
} // namespace shape

} // namespace ncvet
