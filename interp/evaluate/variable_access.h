// Reads and writes the variables of programs.
#pragma once

#include "interp/value/value.h"

namespace ncvet {

struct MachineState; // interp/state/state.h

/// A variable may be written with any number of digits; no control has so many.
constexpr double pastNumbers = 0x1p63;

/// Value of variable `number`: local, common, or unknown for the control's own.
Value readVariable(const MachineState &state, int64_t number);
/// Whether the program has given a named variable no value yet, unknown where it has on some paths;
/// numbered ones keep theirs from one program to the next.
Truth isUnset(const MachineState &state, double number);
/// Whether it is no variable of programs, but one in which the control says what is in force.
bool showsMachine(const MachineState &state, double number);
/// Whether it is a variable of programs to which nothing has been given on any path so far: it has
/// what the operator, or another program, has put there.
bool isUntouched(const MachineState &state, double number);
void writeVariable(MachineState &state, int64_t number, const Value &value);

/// Keys of the variables in which a subprogram between brackets gives a value back, and in which it
/// says whether it does.
uint64_t givenBackKey();
uint64_t isGivenBackKey();

} // namespace ncvet
