// A block that has been executed, with what it did and the states around it.
#pragma once

#include "formats/dialect/machine.h"
#include "interp/state/event.h"

namespace ncvet {

/// An executed block. Refers to what it is made of and keeps nothing.
struct ExecutedBlock {
  const Dialect &dialect;
  const MachineProfile &machine;
  const Block &block;
  const Outcome &outcome;
  const MachineState &before;
  const MachineState &after;
};

} // namespace ncvet
