// Which states look at which block while programs run.
#pragma once

#include "analyzer/rule/path_node.h"

#include "llvm/ADT/SmallVector.h"

namespace ncvet {

/// A stop is one block that is executed, once for each state that is kept apart: `begin`, then one
/// `visit` for each state, then `end`. Stops nest: a visit that calls a program holds the stops of
/// that program.
class Visits {
public:
  struct Stop {
    const PathNode *path = nullptr; ///< of the current visit
    unsigned visits = 0;            ///< up to the current one
    bool reported = false;          ///< something was reported at this stop
  };

  void begin() { stops_.emplace_back(); }
  void visit(const PathNode *path) {
    Stop &stop = stops_.back();
    stop.path = path;
    ++stop.visits;
  }
  void end() { stops_.pop_back(); }

  size_t depth() const { return stops_.size(); }
  /// `depth` from 1, the outermost.
  const Stop &at(size_t depth) const { return stops_[depth - 1]; }
  void noteReport(size_t depth) { stops_[depth - 1].reported = true; }
  bool isReported() const { return stops_.back().reported; }

private:
  llvm::SmallVector<Stop, 16> stops_;
};

} // namespace ncvet
