// Texts with values in them, in the form of llvm::formatv.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"
#include "llvm/Support/Format.h"
#include "llvm/Support/FormatVariadicDetails.h"

#include <array>
#include <concepts>
#include <cstdint>
#include <string>

namespace ncvet {

/// One value of a text: of what type it was is known here alone. llvm::formatv is a template for
/// every mixture of types, and thousands of those were a tenth of the build.
///
/// Refers to the text that it is made of, for as long as the call that it is made for.
class TextArgument final : public llvm::detail::format_adapter {
public:
  TextArgument(llvm::StringRef text) : kind_(Kind::Text), text_(text) {}
  TextArgument(const std::string &text) : kind_(Kind::Text), text_(text) {}
  TextArgument(const char *text) : kind_(Kind::Text), text_(text) {}
  /// Of llvm::format.
  TextArgument(const llvm::format_object_base &printed)
      : kind_(Kind::Printed), printed_(&printed) {}
  template <std::floating_point T>
  TextArgument(T number) : kind_(Kind::Real), real_(number) {}
  template <std::same_as<char> T>
  TextArgument(const T &letter) : kind_(Kind::Text), text_(&letter, 1) {}
  template <std::signed_integral T>
  requires(!std::same_as<T, char>) TextArgument(T number) : kind_(Kind::Signed), whole_(number) {}
  template <std::unsigned_integral T>
  TextArgument(T number) : kind_(Kind::Unsigned), whole_(int64_t(number)) {}

  void format(llvm::raw_ostream &out, llvm::StringRef style) override;

private:
  enum class Kind : uint8_t { Text, Printed, Real, Signed, Unsigned };
  Kind kind_;
  llvm::StringRef text_;
  const llvm::format_object_base *printed_ = nullptr;
  double real_ = 0;
  int64_t whole_ = 0;
};

/// The text with `{0}`, `{1:f2}` … replaced by the values.
std::string formatted(llvm::StringRef form, llvm::MutableArrayRef<TextArgument> values);

template <typename... Values>
std::string formatted(llvm::StringRef form, const Values &...values) {
  std::array<TextArgument, sizeof...(Values)> list{TextArgument(values)...};
  return formatted(form, llvm::MutableArrayRef<TextArgument>(list.data(), list.size()));
}

} // namespace ncvet
