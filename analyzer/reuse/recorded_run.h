// A run of plain blocks that an earlier analysis of almost the same text has followed.
#pragma once

#include "analyzer/program/span_store.h"
#include "analyzer/reuse/continuation_move.h"
#include "analyzer/rule/rule.h"

#include "llvm/ADT/DenseSet.h"

namespace ncvet {

/// A run of blocks that are executed one after the other, and in which no rule reported anything.
/// It can be applied again where the text is the same, the state is equal in everything that the
/// run reads or sets, and the rules remember the same.
struct StraightRun : RunPlace {
  uint32_t from = 0, to = 0; ///< the text that was looked at for it
  bool isClean = true;       ///< a reader finds nothing wrong in it
  StateUse use;
  CutArea::Box cut = CutArea::none; ///< what is added to it
  DepthMoves depth;
  KnownState entry, exit;
  PlainRun plainEntry, plainExit;
  RuleMemory memory;   ///< at its begin, and at its end as well
  Gatherings gathered; ///< what it adds to it

  explicit StraightRun(FileId file) : memory(file) {}

  /// It ends here, has used this much, and things were set there when it began.
  void finish(const StateUse &used, const OriginState &before, const MachineState &after,
              const PlainRun &plainAfter);
  /// Whether the state becomes what it became then. What rules remember is another matter.
  bool leadsFrom(const MachineState &state, const PlainRun &plain) const;
  /// Whether it does the same from here.
  bool begins(const MachineState &state, const PlainRun &plain, const RuleMemory &now) const;
  /// Applies the recorded run: turns its entry state into its exit state.
  void carry(MachineState &state, PlainRun &plain) const;
  /// `next` begins where it ends, and has been taken over there: the two are one.
  void join(const StraightRun &next, const MachineState &after, const PlainRun &plainAfter);
  /// What is gathered once, runs and the longer ones that they became share.
  using Moved = llvm::DenseSet<const Gathered *>;
  /// What happens to it when text before it changes. `moved`: what was moved already.
  void move(const TextChange &change, Moved &moved);
  /// Whether something that it looks at was set in the changed text.
  bool stemsFrom(const TextChange &change) const;

private:
  bool sparesLevel(const KnownState &state) const;

  /// Where things were set that it looks at or sets, in the order of their places in the state.
  std::vector<Origin> entryOrigins_, exitOrigins_;
};

} // namespace ncvet
