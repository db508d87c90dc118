// Lengths as messages show them: in the unit of the program.
#include "analyzer/facts/length_text.h"

#include "analyzer/facts/lookahead.h"
#include "formats/text/formatted.h"
#include "formats/text/number_text.h"

namespace ncvet {

namespace {

/// The unit in force after the block.
struct Unit {
  double millimetres = 1;
  const char *name = " mm"; ///< with a blank before it; empty: nothing says it

  explicit Unit(const RuleContext &ctx) {
    const GroupIndex group = ctx.dialect().group(StandardGroup::Units);
    const auto known = millimetresPer(ctx.dialect(), ctx.after());
    millimetres = known.value_or(1);
    if (isInch())
      name = " inch";
    else if (!known || (group != noGroup && ctx.after().group(group) == groupUnset))
      name = "";
  }

  bool isInch() const { return millimetres > 1; }
};

std::string number(const Unit &unit, double mm) {
  const double value = mm / unit.millimetres;
  return unit.isInch() ? formatted("{0:f4}", value) : formatted("{0:f3}", value);
}

} // namespace

std::string lengthText(const RuleContext &ctx, double mm) {
  const Unit unit(ctx);
  return number(unit, mm) + unit.name;
}

std::string shortLength(const RuleContext &ctx, double mm) {
  const Unit unit(ctx);
  return shortNumber(mm / unit.millimetres) + unit.name;
}

std::string shortPlace(const RuleContext &ctx, double mm) {
  return shortNumber(mm / Unit(ctx).millimetres);
}

std::string placeText(const RuleContext &ctx, double mm) { return number(Unit(ctx), mm); }

} // namespace ncvet
