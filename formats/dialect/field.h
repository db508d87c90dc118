// Fields of records out of pointers to members: how a key's value reaches its place in a struct.
#pragma once

#include "formats/dialect/address.h"
#include "formats/dialect/formula.h"
#include "formats/dialect/json_reader.h"
#include "formats/dialect/shape.h"

#include <type_traits>
#include <vector>

namespace ncvet {

/// Each leaves the target as it is, with an error, when the value does not fit the shape.
void readValue(JsonReader &in, const Shape &shape, const Json &value, std::string &target);
void readValue(JsonReader &in, const Shape &shape, const Json &value, bool &target);
void readValue(JsonReader &in, const Shape &shape, const Json &value, double &target);
void readValue(JsonReader &in, const Shape &shape, const Json &value,
               std::vector<std::string> &target);
/// These need the table that the names in them belong to: `in` is a `DialectBuilder`.
void readValue(JsonReader &in, const Shape &shape, const Json &value, AddressMask &target);
void readValue(JsonReader &in, const Shape &shape, const Json &value, Formula &target);

/// The index of a name, or a whole number, by the shape.
std::optional<long> readIndex(JsonReader &in, const Shape &shape, const Json &value);

/// The elements of a list of the right length.
std::vector<const Json *> readList(JsonReader &in, const Shape &shape, const Json &value);

template <typename T>
void readValue(JsonReader &in, const Shape &shape, const Json &value, T &target) {
  if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
    if (const std::optional<long> index = readIndex(in, shape, value))
      target = T(*index);
  } else {
    readRecord(in, value, *shape.record, &target);
  }
}
template <typename T>
void readValue(JsonReader &in, const Shape &shape, const Json &value, std::optional<T> &target) {
  T read{};
  readValue(in, shape, value, read);
  if (!in.failed())
    target = read;
}

/// A list of objects.
template <typename T>
void readValue(JsonReader &in, const Shape &shape, const Json &value, std::vector<T> &target) {
  for (const Json *element : readList(in, shape, value))
    readValue(in, *shape.of, *element, target.emplace_back());
}

/// What a fresh struct holds, as JSON; empty: nothing.
std::string jsonOf(const Shape &shape, const std::string &value);
std::string jsonOf(const Shape &shape, bool value);
std::string jsonOf(const Shape &shape, double value);
std::string nameOf(const Shape &shape, long value);
template <typename T>
std::string jsonOf(const Shape &shape, const T &value) {
  if constexpr (std::is_same_v<T, AddressMask>)
    return {};
  else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>)
    return nameOf(shape, long(value));
  else
    return {};
}

template <typename Pointer>
struct MemberPointer;
template <typename O, typename M>
struct MemberPointer<M O::*> {
  using Owner = O;
  using Type = M;
};

/// The member at the end of a chain of pointers to members.
template <auto First, auto... Rest>
auto &reach(auto &owner) {
  if constexpr (sizeof...(Rest) == 0)
    return owner.*First;
  else
    return reach<Rest...>(owner.*First);
}

/// A key whose value goes into a member: `field<&Limits::callDepth>("callDepth", …)`; or into a
/// member of a member, `field<&WordSpec::range, &ValueTest::min>`.
template <auto First, auto... Rest>
constexpr Field field(llvm::StringLiteral key, Shape shape, llvm::StringLiteral meaning,
                      llvm::StringLiteral example = "") {
  using Owner = typename MemberPointer<decltype(First)>::Owner;
  Field made{key, shape, meaning, example};
  made.read = [](JsonReader &in, const Shape &form, const Json &value, void *target) {
    readValue(in, form, value, reach<First, Rest...>(*static_cast<Owner *>(target)));
  };
  made.fallback = [](const Shape &form, const void *defaults) {
    return jsonOf(form, reach<First, Rest...>(*static_cast<const Owner *>(defaults)));
  };
  return made;
}
/// A key whose value is true or false.
template <auto... Path>
constexpr Field flag(llvm::StringLiteral key, llvm::StringLiteral meaning,
                     llvm::StringLiteral example = "true") {
  return field<Path...>(key, shape::boolean, meaning, example);
}

/// Type of the reader or builder and of the struct that a function which reads a value takes.
template <typename Function>
struct FieldFunction;
template <typename R, typename T>
struct FieldFunction<void (R::*)(const Json &, T &)> {
  using Target = T;
  template <auto Read>
  static void call(JsonReader &in, const Json &value, void *target) {
    (static_cast<R &>(in).*Read)(value, *static_cast<T *>(target));
  }
};
template <typename T>
struct FieldFunction<void (*)(JsonReader &, const Json &, T &)> {
  using Target = T;
  template <auto Read>
  static void call(JsonReader &in, const Json &value, void *target) {
    Read(in, value, *static_cast<T *>(target));
  }
};

/// A key that takes more than its form to read: a function of the reader, or one of its own.
template <auto Read>
constexpr Field special(llvm::StringLiteral key, Shape shape, llvm::StringLiteral meaning,
                        llvm::StringLiteral example = "") {
  Field made{key, shape, meaning, example};
  made.read = [](JsonReader &in, const Shape &, const Json &value, void *target) {
    FieldFunction<decltype(Read)>::template call<Read>(in, value, target);
  };
  return made;
}

/// A key whose object has keys for members of the same struct.
constexpr Field within(llvm::StringLiteral key, const Record &record, llvm::StringLiteral meaning) {
  Field made{key, shape::object(record), meaning, ""};
  made.read = [](JsonReader &in, const Shape &shape, const Json &value, void *target) {
    readRecord(in, value, *shape.record, target);
  };
  return made;
}

/// A key that is known here and read before or after the record.
constexpr Field elsewhere(llvm::StringLiteral key, Shape shape, llvm::StringLiteral meaning,
                          llvm::StringLiteral example = "") {
  return Field{key, shape, meaning, example};
}

} // namespace ncvet
