// Lengths as messages show them: in the unit of the program.
#pragma once

#include "analyzer/rule/rule.h"

#include <string>

namespace ncvet {

/// A length in mm as the current program counts it: "2.540 mm", "0.1000 inch"; "2.540" alone where
/// nothing says the unit, and the value is the one that the program has.
std::string lengthText(const RuleContext &ctx, double mm);
/// The same without zeros at the end: "2.54 mm", "0.1 inch".
std::string shortLength(const RuleContext &ctx, double mm);
/// A place in mm as the current program counts it, without its unit: "2.540", "0.1000".
std::string placeText(const RuleContext &ctx, double mm);
/// The same without zeros at the end: "2.54", "0.1".
std::string shortPlace(const RuleContext &ctx, double mm);

} // namespace ncvet
