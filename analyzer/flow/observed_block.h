// The machine's states on all paths that come by one block.
#pragma once

#include "analyzer/flow/activation.h"
#include "analyzer/flow/flow_listener.h"

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

/// Keeps the states that come by one block.
class ObservedBlock final : public FlowListener {
public:
  ObservedBlock(FileId file, uint32_t offset) : file_(file), offset_(offset) {}

  FlowInterest interest() const override { return {0, false, true, false}; }
  void executed(const Step &step, bool continues) override;
  bool mustSee(FileId file, uint32_t begin, uint32_t end) const override {
    return file == file_ && begin <= offset_ && offset_ < end;
  }

  StatesAt states;

private:
  FileId file_;
  uint32_t offset_;
};

} // namespace ncvet
