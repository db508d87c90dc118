// Writes the motions of a cycle one after the other. Private to the files that take cycles apart.
#pragma once

#include "interp/cycles/move_feed.h"
#include "interp/evaluate/condition.h"
#include "interp/evaluate/cycle_words.h"
#include "interp/state/modes.h"

namespace ncvet {

/// A cycle in its block, and the place of the tool while its motions are written.
class CycleWriter {
protected:
  CycleWriter(const ExecutedBlock &executed, const CodeInfo &cycle,
              llvm::SmallVectorImpl<Move> &moves)
      : executed_(executed), cycle_(cycle), words_(executed, cycle), at_(executed.before.position),
        machineAxes_(executed.before.machineAxes), moves_(moves), most_(moves.size() + mostMoves) {}

  /// A motion, or what is between two, with the tool at `at_`.
  Move &go(MoveKind kind) {
    if (moves_.size() >= most_)
      return spare_ = Move();
    Move &move = moves_.emplace_back();
    move.kind = kind;
    move.to = at_;
    move.machineAxes = machineAxes_;
    if (kind == MoveKind::Linear || kind == MoveKind::Thread)
      setFeed(executed_.dialect, executed_.after, move);
    return move;
  }
  Move &go(MoveKind kind, Axis axis, const Interval &place) {
    at_[size_t(axis)] = place;
    machineAxes_ &= ~(1u << unsigned(axis));
    return go(kind);
  }

  /// Whether the word gives a place along the axis.
  bool namesAxis(const WordSpec &spec, Axis axis) const {
    for (unsigned letter = 0; letter < 26; ++letter)
      if (spec.any >> letter & 1 && executed_.dialect.addresses[letter].axis == axis &&
          maskOf(AddressId(letter)) & executed_.dialect.axisWords)
        return true;
    return false;
  }

  /// No cycle makes more steps than this: smaller ones are an error that rules report.
  static constexpr unsigned mostSteps = 10000;
  static constexpr double tolerance = 1e-9; ///< mm

  const ExecutedBlock &executed_;
  const CodeInfo &cycle_;
  const CycleWordReader words_;
  Place at_;
  uint32_t machineAxes_;

private:
  /// A cycle with more of them is not followed further than so many.
  static constexpr size_t mostMoves = 50000;

  llvm::SmallVectorImpl<Move> &moves_;
  const size_t most_;
  Move spare_; ///< takes what is not followed
};

} // namespace ncvet
