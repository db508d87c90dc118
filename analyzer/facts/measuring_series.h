// Codes between which a series of measurements is.
#pragma once

#include "formats/dialect/dialect.h"

namespace ncvet {

/// Whether the code begins or ends a series: it turns the switch of which probe-series-unbalanced
/// speaks.
inline bool turnsSeries(const CodeInfo &code, const Dialect &dialect) {
  return code.effect.index < dialect.switches.size() &&
         dialect.switches[code.effect.index].leftOn == "probe-series-unbalanced";
}
inline bool endsSeries(const CodeInfo &code, const Dialect &dialect) {
  return !code.effect.on && turnsSeries(code, dialect);
}

} // namespace ncvet
