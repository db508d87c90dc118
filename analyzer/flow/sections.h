// Sections of a program that a block runs again.
#pragma once

#include "analyzer/flow/jump_targets.h"
#include "analyzer/flow/passes.h"

namespace ncvet {

/// Carries out repeats: `REPEAT`, `REPEATB`, and what other controls call so.
class Sections {
public:
  Sections(FlowRun &run, Loops &loops, JumpTargets &targets, CalledBodies &bodies,
           PassRunner &passes)
      : run_(run), loops_(loops), targets_(targets), bodies_(bodies), passes_(passes) {}

  /// Runs a section again, and goes on after the block, or after the section when the block is its
  /// head.
  void repeat(Step &step);

private:
  /// The first and last block of a section.
  struct Bounds {
    uint32_t first, last;
  };
  std::optional<Bounds> boundsOf(const Step &step, const Item &item);
  bool isWrong(Step &step, const Item &item, const Bounds &bounds);
  void report(const Step &step, const Bounds &bounds, uint32_t start, uint32_t end);

  FlowRun &run_;
  Loops &loops_;
  JumpTargets &targets_;
  CalledBodies &bodies_;
  PassRunner &passes_;
};

} // namespace ncvet
