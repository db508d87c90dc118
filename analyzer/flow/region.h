// A piece of a program that is run, and the states that run through it.
#pragma once

#include "analyzer/flow/held_state.h"
#include "analyzer/program/call_site.h"
#include "analyzer/program/project.h"
#include "analyzer/rule/path_node.h"

#include <tuple>

namespace ncvet {

struct DecidedCondition; // analyzer/flow/decided_conditions.h

/// The operator's switch for one level of block skip, as far as a path has decided it.
enum class SkipSwitch : uint8_t { Unknown, Off, On };

/// By level.
using SkipSwitches = std::array<SkipSwitch, 10>;

/// One state on its path, and how it came there.
struct Live {
  HeldState state;
  const PathNode *path = nullptr;
  /// Block skip switch per level, as far as this path has decided it.
  SkipSwitches skip{};
  /// Conditions that this path has decided.
  const DecidedCondition *decided = nullptr;
};
using Lives = llvm::SmallVector<Live, 1>;

enum class RegionKind : uint8_t { Main, Subprogram, LocalSubprogram, Profile, Section };

/// What is run as one: a program, or a part of one.
struct Region {
  FileUnit &unit;
  const ProgramInfo &program;
  uint32_t start;
  RegionKind kind;
  const CallSite *caller = nullptr; ///< null: nothing that is known calls it
  uint32_t lastBlock = ~0u;         ///< profile: offset of the last block
  uint32_t stopAt = ~0u;            ///< section: offset after its last block

  /// Number of calls between the main program and this.
  unsigned depth() const { return caller ? caller->depth : 0; }
};

/// A region that is being executed: its file, start, kind and end. Sections and profiles of one
/// start may end at different blocks, and one may hold the other.
using RunningRegion = std::tuple<FileId, uint32_t, RegionKind, uint32_t>;

inline RunningRegion keyOf(const Region &region) {
  const uint32_t end = region.kind == RegionKind::Section   ? region.stopAt
                       : region.kind == RegionKind::Profile ? region.lastBlock
                                                            : ~0u;
  return {region.unit.source.id(), region.start, region.kind, end};
}

/// A state that has left a region.
struct Returned {
  Live live;
  int64_t target = notSet; ///< number of the caller's block to go on with
};
using Exits = std::vector<Returned>;

} // namespace ncvet
