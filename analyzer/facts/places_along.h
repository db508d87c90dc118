// The places along Z to which the blocks of a program lead, as its text says.
#pragma once

#include "analyzer/rule/rule.h"
#include "analyzer/rule/text_answers.h"

namespace ncvet {

struct PlacesAlong {
  /// The lowest one and the one above it; zeros where the program has subprograms, or computes.
  std::pair<double, double> lowest{};
  /// How many blocks lead to a place below zero by a code of their own.
  struct Ways {
    unsigned fed = 0; ///< along Z alone
    unsigned rapid = 0;
  };
  std::map<double, Ways> below;
  unsigned fedRapids = 0; ///< blocks with a code for rapid moves and a feed
  /// Blocks that move with a feed, where no block has a code for a feed move or leads elsewhere.
  unsigned neverFed = 0;
};

/// Those of the programs that a rule asks for, each read once.
class PlacesOfPrograms {
public:
  const PlacesAlong &of(const RuleContext &ctx) const;

private:
  TextAnswers<std::pair<FileId, uint32_t>, PlacesAlong> known_;
};

} // namespace ncvet
