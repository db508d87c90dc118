// JSON values as text, for all that is written.
#pragma once

#include <string>

namespace ncvet {

/// A value (of either kind of nlohmann's) in one line. Bytes of programs that are no UTF-8 become
/// replacement characters; without that, writing them would throw.
template <typename Json>
std::string jsonText(const Json &value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace ncvet
