// Codes that end a program, or return from it.
#pragma once

#include "analyzer/program/project.h"
#include "analyzer/reuse/run_cache.h"

namespace ncvet {

/// What a piece of text holds.
struct Endings {
  bool ends = false;    ///< a code that ends a main program
  bool returns = false; ///< a code that returns from a subprogram

  void add(const Block &block, const Dialect &dialect);
  bool any() const { return ends || returns; }
};

/// Those of all blocks of [begin, end). `runs`, when given, holds what was read before.
Endings endingsOf(const FileUnit &unit, uint32_t begin, uint32_t end, StraightRuns *runs);

/// Whether a block between two places ends the program, or returns.
bool holdsEnd(const FileUnit &unit, uint32_t begin, uint32_t end);

/// Whether a block between two places can leave them: a jump, a return, a stop, an answer.
bool holdsWayOut(const FileUnit &unit, uint32_t begin, uint32_t end);

} // namespace ncvet
