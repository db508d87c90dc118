// What the words of a cycle say, by their roles: in the block, kept from an earlier one, or in the
// variables that the cycle reads.
#pragma once

#include "interp/state/executed_block.h"

#include <optional>

namespace ncvet {

class CycleWordReader {
public:
  CycleWordReader(const ExecutedBlock &executed, const CodeInfo &cycle)
      : executed_(executed), cycle_(cycle) {}

  /// The cycle's word with that role; null when its format has none.
  const WordSpec *spec(Role role) const;
  /// Value of a word, lengths in millimetres; none when it is not given, and unknown when it is
  /// given and not known.
  std::optional<Interval> value(const WordSpec &spec) const;
  std::optional<Interval> value(Role role) const;
  /// Whether the word was given as an increment of its axis (U, W).
  bool isIncrement(const WordSpec &spec) const;

private:
  bool inch() const;
  std::optional<Interval> kept(unsigned place, bool length) const;

  const ExecutedBlock &executed_;
  const CodeInfo &cycle_;
};

/// Whether `next` goes on with the words of the cycle that is in force: a drilling code after
/// another one, on a control that keeps them until none is active any more.
bool takesOverWords(const CodeInfo &next, const Dialect &dialect, const MachineState &before);

} // namespace ncvet
