// Numbers as hints and help show them.
#pragma once

#include "interp/value/value.h"

#include <string>

namespace ncvet::lsp {

/// At most four decimals, none that are zero: `12.5`, `-0.1`, `200`.
std::string numberText(double value);
/// `12.5`, `1 to 5`, `at least 1`; empty when nothing is known.
std::string intervalText(const Interval &interval);

} // namespace ncvet::lsp
