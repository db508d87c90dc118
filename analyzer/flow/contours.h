// Contours and profiles that cycles read, or run.
#pragma once

#include "analyzer/flow/called_bodies.h"
#include "analyzer/flow/callees.h"
#include "interp/cycles/contour_cycle.h"

namespace ncvet {

/// Carries out blocks whose cycle works along blocks that are written elsewhere.
class Contours {
public:
  Contours(FlowRun &run, Callees &callees, CalledBodies &bodies)
      : run_(run), callees_(callees), bodies_(bodies) {}

  /// A cycle reads a program as the contour that it works along.
  void contour(Step &step);
  /// A cycle reads the blocks between two numbers: as data when it roughs, for real when it
  /// finishes.
  void profile(Step &step);

private:
  /// The first and last block of a profile.
  struct Bounds {
    uint32_t first, last;
  };
  void turnedContour(Step &step, const CodeInfo &cycle);
  void namedContour(Step &step, const CodeInfo &cycle);
  void numberedContour(Step &step, const CodeInfo &cycle);
  void section(const Step &step, llvm::StringRef labels);
  void read(Step &step, const CodeInfo &cycle, const Callee &callee,
            std::optional<ContourCycle> works);
  std::optional<Bounds> boundsOf(const Step &step);
  void notePlace(const Step &step, const Bounds &bounds, bool finishing);
  void goOnFinished(Step &step, Exits exits);
  static bool isAdjacent(const Step &step, uint32_t first);

  FlowRun &run_;
  Callees &callees_;
  CalledBodies &bodies_;
  unsigned passesFollowed_ = 0; ///< cycles whose passes were made to see where they end
};

} // namespace ncvet
