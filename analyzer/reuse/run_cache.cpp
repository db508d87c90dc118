// What is known of the blocks of a file: what an edit does to it.
#include "analyzer/reuse/run_cache.h"

namespace ncvet {

void StraightRuns::edit(const TextChange &change) {
  const bool moves = change.end != change.endAfter(); // else all places stay
  StraightRun::Moved moved;
  // Text that is put in right at an end may belong to the block there.
  for (RunStore<StraightRun> *runs : {&straight, &stretches, &chains[0], &chains[1]})
    runs->edit([&](StraightRun &run) {
      if ((change.begin <= run.to && change.end >= run.from) || run.stemsFrom(change))
        return true;
      if (moves)
        run.move(change, moved);
      return false;
    });
  calls.edit(change, moved);
  const auto spoils = [&](RunPlace &run) {
    if (change.begin <= run.end && change.end >= run.begin)
      return true;
    if (run.begin >= change.end)
      run.move(change);
    return false;
  };
  endings.edit(spoils);
  quiet.edit(spoils);
}

} // namespace ncvet
