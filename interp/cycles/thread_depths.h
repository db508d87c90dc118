// How deep each pass of a turned thread cuts.
#pragma once

#include "interp/evaluate/cycle_parameters.h"

namespace ncvet {

/// Depths of the passes below the crest, as radii in millimetres. None when the words do not say
/// them: only the last pass is certain then.
llvm::SmallVector<double, 32> threadDepths(const CycleParameters &parameters);

/// The measure as a number; `otherwise` when the table does not name it or it is not known.
double knownOr(const CycleParameters &parameters, Measure what, double otherwise);

/// Whether each pass goes straight in. A tool that follows a flank begins elsewhere for each depth;
/// the manuals do not say where.
bool feedsStraightIn(const CycleParameters &parameters);

} // namespace ncvet
