// Rapid moves of a lathe that lead into the work or to the chuck.
#pragma once

#include "analyzer/facts/places_along.h"
#include "analyzer/facts/turned_shape.h"

namespace ncvet {

/// Reports them for the rule at work.
class TurningRapids {
public:
  /// To below what is left of the work, into its face, or through what was just turned.
  void intoWork(const Event &event, const PlacesOfPrograms &places, RuleContext &ctx) const {
    onAxis(event, places, ctx);
    intoTurned(event, ctx);
    throughTurned(event, ctx);
  }
  /// To the place where the program changes its tools, but for the sign of Z.
  static void towardsChuck(const Event &event, RuleContext &ctx);
  /// A rapid move along the work with a feed in its block, after which the tool retracts at once.
  /// It has cut nothing, or everything at full speed: G1 was meant. `feedsRapids`: such moves are
  /// the habit of the program.
  static void alongWork(const Event &event, bool &feedsRapids, RuleContext &ctx);

private:
  void intoTurned(const Event &event, RuleContext &ctx) const;
  void onAxis(const Event &event, const PlacesOfPrograms &places, RuleContext &ctx) const;
  static void throughTurned(const Event &event, RuleContext &ctx);

  TurnedShapes shapes_;
};

/// A code of the block takes its words: engraving or another cycle, while G00 is in force.
bool takesWordsItself(const RuleContext &ctx);

} // namespace ncvet
