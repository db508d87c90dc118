// Finds the words of a block that a table's formats name, and reads their values.
#pragma once

#include "formats/dialect/machine.h"
#include "formats/readers/block.h"
#include "interp/state/state.h"

namespace ncvet {

/// The word of the block's last assignment to the variable with this key, or null.
const Word *assignmentOf(const Block &block, uint64_t variable);
/// The word of the block that `spec` speaks of: by its address, its place among the arguments, or
/// the variable that it sets. Null when there is none; an argument left empty counts as none.
const Word *wordFor(const Block &block, const WordSpec &spec);

/// Key of the variable used in place of `spec`'s word: the one of its two that the program has
/// given a value.
uint64_t givenVariable(const WordSpec &spec, const MachineState &state);
/// Whether blocks before have given the variable used in place of `spec`'s word a value.
Truth givenBefore(const WordSpec &spec, const MachineState &state);

/// The code that a word is, without its variants; `noCode` for other words and unknown codes.
CodeIndex codeOf(const Dialect &dialect, const Word &word);

/// Value of a word as written: a number, or an expression's value on the state.
Interval wordValue(const Word &word, const Block &block, const MachineState &state);

/// A length of the block in millimetres (other values as written), by the units in force and the
/// profile's reading of numbers without a point.
Interval lengthOf(const Word &word, const Block &block, const Dialect &dialect,
                  const MachineProfile &machine, const MachineState &state);

} // namespace ncvet
