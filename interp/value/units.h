// Factors between the units in which programs are written and those in which ncvet calculates.
#pragma once

namespace ncvet {

constexpr double millimetresPerInch = 25.4;
/// Least increment of a metric control, in millimetres.
constexpr double leastIncrement = 0.001;

} // namespace ncvet
