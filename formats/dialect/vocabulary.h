// The words that tables may use for roles, cycles, kinds and groups: name lists in enum order.
#pragma once

#include "formats/dialect/dialect.h"

namespace ncvet {

/// Spellings in the order of the enumeration; the index is the enumerator's value.
llvm::ArrayRef<llvm::StringLiteral> roleNames();
llvm::ArrayRef<llvm::StringLiteral> cycleNames();
llvm::ArrayRef<llvm::StringLiteral> frameNames();
llvm::ArrayRef<llvm::StringLiteral> needNames();
llvm::ArrayRef<llvm::StringLiteral> namingNames();
llvm::ArrayRef<llvm::StringLiteral> pointNames();
llvm::ArrayRef<llvm::StringLiteral> spindleNames();
llvm::ArrayRef<llvm::StringLiteral> addressKindNames();
llvm::ArrayRef<llvm::StringLiteral> addressUnitNames();
llvm::ArrayRef<llvm::StringLiteral> arcWordNames();       ///< of an address: "radius", "through-x"
llvm::ArrayRef<llvm::StringLiteral> addressActionNames(); ///< "speed-limit", ...
llvm::ArrayRef<llvm::StringLiteral> codeNeedNames();      ///< "feed", "speed"
llvm::ArrayRef<llvm::StringLiteral> axisNames();
llvm::ArrayRef<llvm::StringLiteral> machineNames();
llvm::ArrayRef<llvm::StringLiteral> semicolonNames();
llvm::ArrayRef<llvm::StringLiteral> arithmeticNames();
llvm::ArrayRef<llvm::StringLiteral> severityNames();
llvm::ArrayRef<llvm::StringLiteral> standardGroupNames();

} // namespace ncvet
