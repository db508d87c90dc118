// Where the tool goes after a move: on, home, or up again with nothing done.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// What comes next of a move, and of the way home, to the next tool or to the end.
enum class Station : uint8_t { None, Move, Home };
Station nextStation(const RuleContext &ctx);

/// Whether the next place along Z, the way home or the end comes before any cut.
bool doesNothingHere(const RuleContext &ctx);

/// The next block feeds the tool in the plane, at the height where it is.
bool cutsOnAcross(const RuleContext &ctx);

/// Without a stock: the next move leads up again from there, so that the tool has not gone past
/// the part. Where no move follows, nothing is known of it.
bool cutsAcross(const RuleContext &ctx);

/// The block before feeds the tool in the plane alone.
bool hasCutAcross(const RuleContext &ctx);

/// Whether the next place along Z, to which no cut leads, is above the present one.
bool risesNext(const RuleContext &ctx);

/// Whether the next block leads at rapid to above zero, along Z alone.
bool comesUpNext(const RuleContext &ctx);

/// A mill: the next block feeds the tool up, along its axis alone, and the one after that cuts
/// across.
bool isFedUpNext(const RuleContext &ctx);

} // namespace ncvet
