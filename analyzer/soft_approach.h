// Which codes lead the tool softly onto a compensated contour.
#pragma once

#include "formats/dialect/dialect.h"

namespace ncvet {

/// Codes of an approach on a line, a quadrant or a semicircle (SINUMERIK: G147, G247, G347).
inline llvm::SmallVector<CodeIndex, 4> softApproaches(const Dialect &dialect) {
  llvm::SmallVector<CodeIndex, 4> codes;
  for (const CodeInfo &code : dialect.codes)
    if (llvm::StringRef(code.title).startswith("approach on"))
      codes.push_back(code.base);
  return codes;
}

/// Codes of the retracts that belong to them (G148, G248, G348).
inline llvm::SmallVector<CodeIndex, 4> softRetracts(const Dialect &dialect) {
  llvm::SmallVector<CodeIndex, 4> codes;
  for (const CodeInfo &code : dialect.codes)
    if (llvm::StringRef(code.title).startswith("retract on"))
      codes.push_back(code.base);
  return codes;
}

} // namespace ncvet
