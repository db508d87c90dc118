// The transfer function: what one block does to the machine's state.
#pragma once

#include "interp/evaluate/condition.h"

namespace ncvet {

/// What the transfer function asks of tables and profile with every block, looked up once.
struct ModeMasks {
  GroupIndex motion, cycle, units, distance, polar, language, diameter, feedMode;
  uint64_t everyBlock = 0; ///< groups that every block depends on
  uint64_t cancelled = 0;  ///< members of the cycle group that mean "no cycle"
  uint64_t inch = 0, metric = 0;
  uint64_t incremental = 0;
  uint64_t polarOn = 0;
  uint64_t foreign = 0;          ///< members of the language group that are not the control's own
  uint64_t diameterOn = 0;       ///< words of X are diameters, its coordinates radii
  uint64_t diameterAbsolute = 0; ///< … where they are no increments
  bool pointlessIsIncrement = false; ///< the profile reads `X100` as 0.1 mm

  ModeMasks(const Dialect &dialect, const MachineProfile &machine);
};

/// Executes blocks of one program text on one control.
class Executor {
public:
  Executor(const Dialect &dialect, const MachineProfile &machine, FileId file);

  /// Whether the rest of the block behind an `IF [..]` is executed; `Yes` for blocks without one.
  /// A jump behind the condition is not meant: its condition goes into the flow.
  Truth guard(const Block &block, const MachineState &state) const;

  /// Executes `block`. `before` must equal `state` on entry; it is what rules and conditions look
  /// at. With `guardHolds` false only what stands in front of the block's IF is executed.
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

/// Whether the text is read, or may be, in the language of another control.
bool inForeignLanguage(const Dialect &dialect, const MachineState &state);
/// Axes of the active plane as a bit mask over `Axis`; the usual plane of the machine's kind when
/// no plane code was stated.
uint16_t planeAxes(const Dialect &dialect, const MachineState &state);
/// Axes of the active plane in the order in which angles count, from the first to the second: X Y,
/// Z X or Y Z.
std::array<Axis, 2> planeOrder(const Dialect &dialect, const MachineState &state);
/// Axis normal to the active plane: the axis along which a drilling cycle drills.
Axis toolAxis(const Dialect &dialect, const MachineState &state);
/// A length of the block in millimetres (other values as written), by the units in force and the
/// profile's reading of numbers without a point.
Interval lengthOf(const Word &word, const Block &block, const Dialect &dialect,
                  const MachineProfile &machine, const MachineState &state);
/// What a word of the axis counts for its coordinate: half where codes have made X a diameter, for
/// coordinates or for increments too. Unknown where they may have.
Interval shareOfDiameter(const Dialect &dialect, const MachineState &state, Axis axis,
                         Truth increment);
/// Bit mask over `Axis` of the axes that the block's words name.
uint16_t axesOf(const Dialect &dialect, const Block &block);

} // namespace ncvet
