// Reads the values of words on a state.
#pragma once

#include "formats/dialect/machine.h"
#include "formats/readers/table_words.h"
#include "interp/value/value.h"

namespace ncvet {

struct MachineState; // interp/state/state.h

/// Key of the variable used in place of `spec`'s word: the one of its two that the program has
/// given a value.
uint64_t givenVariable(const WordSpec &spec, const MachineState &state);
/// Whether blocks before have given the variable used in place of `spec`'s word a value.
Truth givenBefore(const WordSpec &spec, const MachineState &state);

/// Value of a word as written: a number, or an expression's value on the state.
Interval wordValue(const Word &word, const Block &block, const MachineState &state);

/// Millimetres per unit of the word's number, by the units in force and the profile's reading of
/// numbers without a point; 1 for other values than lengths. None: that is not known.
std::optional<double> lengthFactor(const Word &word, const Dialect &dialect,
                                   const MachineProfile &machine, const MachineState &state);

/// A length of the block in millimetres (other values as written), by the units in force and the
/// profile's reading of numbers without a point.
Interval lengthOf(const Word &word, const Block &block, const Dialect &dialect,
                  const MachineProfile &machine, const MachineState &state);

} // namespace ncvet
