// Where the tool goes after a move: on, home, or up again with nothing done.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// What comes next of a move, and of the way home, to the next tool or to the end.
enum class Station : uint8_t { None, Move, Home };
Station nextStation(const RuleContext &ctx);

/// Whether the next block leads at rapid to above zero, along Z alone.
bool comesUpNext(const RuleContext &ctx);

} // namespace ncvet
