// Goes over known runs by their states alone, the longest first.
#include "analyzer/reuse/run_replay.h"

namespace ncvet {

std::optional<RunPlace> RunReplay::takeOver(uint32_t offset, MachineState &state, PlainRun &plain,
                                            llvm::function_ref<bool(const RunPlace &)> may) {
  if (partly_ && offset < partly_->place.end) {
    RunPlace rest = partly_->place;
    rest.begin = offset;
    rest.blocks = 1; // at least: it ends with a block that has content
    if (!may(rest))
      return std::nullopt;
    state = std::move(partly_->exit);
    plain = partly_->plain;
    partly_.reset();
    return rest;
  }
  for (const RunStore<StraightRun> *store :
       {&runs_.chains[1], &runs_.chains[0], &runs_.straight, &runs_.stretches}) {
    const StraightRun *const run = store->find(offset);
    if (!run || !run->leadsFrom(state, plain))
      continue;
    if (may(*run)) {
      run->carry(state, plain);
      runs_.taken.blocks += run->blocks;
      ++runs_.taken.runs;
      return *run;
    }
    // Of a chain the parts are looked at; of a run alone the blocks.
    if (store == &runs_.straight) {
      partly_ = Partly{*run, state, plain};
      run->carry(partly_->exit, partly_->plain);
      return std::nullopt;
    }
  }
  return std::nullopt;
}

} // namespace ncvet
