// The transfer function: what one block does to the machine's state.
#pragma once

#include "interp/evaluate/condition.h"
#include "interp/execute/mode_masks.h"
#include "interp/state/event.h"
#include "interp/state/modes.h"

namespace ncvet {

/// Executes blocks of one program text on one control.
class Executor {
public:
  Executor(const Dialect &dialect, const MachineProfile &machine, FileId file);

  /// The `IF [..]` on which the rest of the block depends; null: there is none.
  static const Item *guardOf(const Block &block);
  /// Whether the rest of the block after an `IF [..]` is executed; `Yes` for blocks without one.
  /// A jump after the condition is not meant: its condition goes into the flow.
  Truth guard(const Block &block, const MachineState &state) const;

  /// Executes `block`. `before` must equal `state` on entry; it is what rules and conditions look
  /// at. With `guardHolds` false only what is before the block's IF is executed.
  void execute(const Block &block, const MachineState &before, MachineState &state,
               Outcome &outcome, bool guardHolds = true) const;

  const Dialect &dialect() const { return dialect_; }
  const MachineProfile &machine() const { return machine_; }
  FileId file() const { return file_; }

private:
  const Dialect &dialect_;
  const MachineProfile &machine_;
  FileId file_;
  ModeMasks masks_;
};

} // namespace ncvet
