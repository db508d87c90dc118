// Values as bytes and back: numbers in as few bytes as they need, and structs by their members.
#pragma once

#include "formats/packed/members.h"

#include "llvm/ADT/StringMap.h"
#include "llvm/ADT/StringRef.h"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ncvet {

/// What a double is packed as.
enum class PackedNumber : uint8_t {
  Zero,
  Infinity,
  MinusInfinity,
  Bits, ///< eight bytes follow
  Whole ///< with the number added, up to 255
};
constexpr double greatestPackedWhole = 255 - double(PackedNumber::Whole);

/// Makes bytes of values.
class Packer {
public:
  explicit Packer(std::string &bytes) : bytes_(bytes) {}

  template <typename... T>
  void all(const T &...values) {
    (one(values), ...);
  }

private:
  void byte(uint8_t value) { bytes_.push_back(char(value)); }
  void number(uint64_t value) {
    for (; value >= 0x80; value >>= 7)
      byte(uint8_t(value | 0x80));
    byte(uint8_t(value));
  }

  template <typename T>
  void one(const T &value) {
    if constexpr (std::is_enum_v<T> || std::is_unsigned_v<T>)
      number(uint64_t(value));
    else if constexpr (std::is_integral_v<T>) // the sign is the last bit
      number(uint64_t(int64_t(value)) << 1 ^ uint64_t(int64_t(value) >> 63));
    else if constexpr (!std::is_pointer_v<T>) // who points is told again after unpacking
      visitMembers(value, [this](const auto &...members) { this->all(members...); });
  }
  void one(double value) {
    if (value == 0 && !std::signbit(value)) {
      byte(uint8_t(PackedNumber::Zero));
    } else if (std::isinf(value)) {
      byte(uint8_t(value > 0 ? PackedNumber::Infinity : PackedNumber::MinusInfinity));
    } else if (value > 0 && value <= greatestPackedWhole && std::floor(value) == value) {
      byte(uint8_t(uint8_t(PackedNumber::Whole) + uint8_t(value)));
    } else {
      byte(uint8_t(PackedNumber::Bits));
      char bits[sizeof value];
      memcpy(bits, &value, sizeof value);
      bytes_.append(bits, sizeof bits);
    }
  }
  void one(llvm::StringRef text) {
    number(text.size());
    bytes_.append(text.data(), text.size());
  }
  void one(const std::string &text) { one(llvm::StringRef(text)); }
  template <typename T>
  void one(const std::vector<T> &list) {
    number(list.size());
    for (const T &element : list)
      one(element);
  }
  template <typename T, size_t N>
  void one(const std::array<T, N> &list) {
    for (const T &element : list)
      one(element);
  }
  template <typename A, typename B>
  void one(const std::pair<A, B> &both) {
    all(both.first, both.second);
  }
  template <typename T>
  void one(const std::optional<T> &value) {
    byte(value.has_value());
    if (value)
      one(*value);
  }
  template <typename T>
  void one(const std::shared_ptr<T> &value) {
    byte(value != nullptr);
    if (value)
      one(*value);
  }
  template <typename A, typename B>
  void one(const std::variant<A, B> &value) {
    byte(uint8_t(value.index()));
    std::visit([this](const auto &held) { this->one(held); }, value);
  }
  template <typename T>
  void one(const std::map<std::string, T> &map) {
    number(map.size());
    for (const auto &[key, value] : map)
      all(key, value);
  }
  template <typename T>
  void one(const llvm::StringMap<T> &map) { // by their keys: the order in it is that of its making
    std::map<std::string, const T *> sorted;
    for (const auto &entry : map)
      sorted.emplace(entry.getKey().str(), &entry.getValue());
    number(sorted.size());
    for (const auto &[key, value] : sorted)
      all(key, *value);
  }

  std::string &bytes_;
};

/// Makes values of the bytes that a `Packer` made of the same types.
class Unpacker {
public:
  explicit Unpacker(llvm::StringRef bytes) : at_(bytes.begin()), end_(bytes.end()) {}

  template <typename... T>
  void all(T &...values) {
    (one(values), ...);
  }
  bool atEnd() const { return at_ == end_; }

private:
  uint8_t byte() {
    assert(at_ < end_ && "what was packed is as long as what is unpacked");
    return uint8_t(*at_++);
  }
  uint64_t number() {
    uint64_t value = byte();
    if (value < 0x80)
      return value;
    value &= 0x7F;
    for (unsigned shift = 7;; shift += 7) {
      const uint64_t next = byte();
      value |= (next & 0x7F) << shift;
      if (next < 0x80)
        return value;
    }
  }

  template <typename T>
  void one(T &value) {
    if constexpr (std::is_enum_v<T> || std::is_unsigned_v<T>) {
      value = T(number());
    } else if constexpr (std::is_integral_v<T>) {
      const uint64_t folded = number();
      value = T(int64_t(folded >> 1 ^ (0 - (folded & 1))));
    } else if constexpr (!std::is_pointer_v<T>) {
      visitMembers(value, [this](auto &...members) { this->all(members...); });
    }
  }
  void one(double &value) {
    const uint8_t form = byte();
    if (form > uint8_t(PackedNumber::Whole)) {
      value = form - uint8_t(PackedNumber::Whole);
    } else if (form == uint8_t(PackedNumber::Bits)) {
      memcpy(&value, at_, sizeof value);
      at_ += sizeof value;
    } else {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      value = form == uint8_t(PackedNumber::Zero)       ? 0
              : form == uint8_t(PackedNumber::Infinity) ? infinity
                                                        : -infinity;
    }
  }
  llvm::StringRef text() {
    const size_t length = size_t(number());
    at_ += length;
    return {at_ - length, length};
  }
  void one(llvm::StringRef &value) { value = text(); }
  void one(std::string &value) {
    if (const llvm::StringRef held = text(); !held.empty())
      value.assign(held.data(), held.size());
    else
      value.clear();
  }
  template <typename T>
  void one(std::vector<T> &list) {
    list.clear();
    if (const size_t length = size_t(number())) {
      list.resize(length);
      for (T &element : list)
        one(element);
    }
  }
  template <typename T, size_t N>
  void one(std::array<T, N> &list) {
    for (T &element : list)
      one(element);
  }
  template <typename A, typename B>
  void one(std::pair<A, B> &both) {
    all(both.first, both.second);
  }
  template <typename T>
  void one(std::optional<T> &value) {
    value.reset();
    if (byte())
      one(value.emplace());
  }
  template <typename T>
  void one(std::shared_ptr<T> &value) {
    value = nullptr;
    if (!byte())
      return;
    auto held = std::make_shared<std::remove_const_t<T>>();
    one(*held);
    value = std::move(held);
  }
  template <typename A, typename B>
  void one(std::variant<A, B> &value) {
    if (byte())
      one(value.template emplace<B>());
    else
      one(value.template emplace<A>());
  }
  template <typename T>
  void one(std::map<std::string, T> &map) {
    map.clear();
    for (size_t left = size_t(number()); left; --left) {
      const std::string key = text().str();
      one(map[key]);
    }
  }
  template <typename T>
  void one(llvm::StringMap<T> &map) {
    map.clear();
    for (size_t left = size_t(number()); left; --left)
      one(map[text()]);
  }

  const char *at_, *end_;
};

} // namespace ncvet
