// The machine's states on all paths that come by one block.
#pragma once

#include "analyzer/flow/region.h"

namespace ncvet {

/// The machine on one path to a block.
struct StateOnWay {
  MachineState before, after;
  std::vector<PathStep> path; ///< calls, jumps and skips that lead there; empty: straight on
};

struct StatesAt {
  std::vector<StateOnWay> ways; ///< empty: nothing reaches the block
  bool joined = false;          ///< the last is that of all further ones
  bool complete = true;         ///< false: the analysis was cut short
};

/// A block whose states are kept while its program runs.
class ObservedBlock {
public:
  ObservedBlock(FileId file, uint32_t offset) : file_(file), offset_(offset) {}

  bool is(FileId file, uint32_t offset) const { return offset == offset_ && file == file_; }
  bool isIn(FileId file, uint32_t begin, uint32_t end) const {
    return file == file_ && begin <= offset_ && offset_ < end;
  }
  /// A state came by the block.
  void note(const MachineState &before, const Live &live);

  StatesAt states;

private:
  FileId file_;
  uint32_t offset_;
};

} // namespace ncvet
