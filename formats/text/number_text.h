// Numbers as messages show them.
#pragma once

#include <string>

namespace ncvet {

/// At most six digits, no zeros at the end of a fraction: `12.5`, `-0.1`, `200`.
std::string shortNumber(double value);

} // namespace ncvet
