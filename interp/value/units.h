// Factors between the units in which programs are written and those in which ncvet calculates.
#pragma once

#include <numbers>

namespace ncvet {

constexpr double millimetresPerInch = 25.4;
constexpr double radiansPerDegree = std::numbers::pi / 180;

} // namespace ncvet
