// What the parts of a debugging session read from arguments.
#pragma once

#include "lsp/debug/debug_channel.h"

namespace ncvet::dap {

/// A control that runs one program at a time has one thread.
constexpr int onlyThread = 1;

/// A member that is a text; `usual` when it is absent or something else.
inline std::string textOf(const Json &object, const char *name, const char *usual = "") {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : usual;
}

/// A member that is true.
inline bool flagOf(const Json &object, const char *name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_boolean() && found->get<bool>();
}

/// A member that is a whole number; `usual` when it is absent or something else.
inline int64_t numberOf(const Json &object, const char *name, int64_t usual = 0) {
  const auto found = object.find(name);
  return found != object.end() && found->is_number_integer() ? found->get<int64_t>() : usual;
}

} // namespace ncvet::dap
