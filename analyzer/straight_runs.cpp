// Runs of plain blocks: what an edit does to them.
#include "analyzer/straight_runs.h"

namespace ncvet {

namespace {

void move(Origin &origin, FileId file, const TextChange &change) {
  if (!origin.known() || origin.file != file)
    return;
  origin.begin = change.moved(origin.begin);
  origin.end = change.moved(origin.end);
}

void move(MachineState &state, FileId file, const TextChange &change) {
  forEachOrigin(state.origin, [&](Origin &origin) { move(origin, file, change); });
}

/// Whether something that the state tells of was set in the changed text.
bool stemsFrom(const MachineState &state, FileId file, const TextChange &change) {
  bool stems = false;
  forEachOrigin(state.origin, [&](const Origin &origin) {
    stems |= origin.known() && origin.file == file && !change.spares(origin.begin, origin.end);
  });
  return stems;
}

} // namespace

void StraightRuns::edit(const TextChange &change) {
  // Text that is put in right at an end may belong to the block there.
  straight.edit([&](StraightRun &run) {
    const FileId file = run.memory.file();
    if ((change.begin <= run.to && change.end >= run.from) || stemsFrom(run.entry, file, change))
      return true;
    if (run.from >= change.end) {
      run.RunPlace::move(change);
      run.from = change.moved(run.from);
      run.to = change.moved(run.to);
    }
    move(run.entry, file, change);
    move(run.exit, file, change);
    run.memory.move(change);
    return false;
  });
  const auto spoils = [&](RunPlace &run) {
    if (change.begin <= run.end && change.end >= run.begin)
      return true;
    if (run.begin >= change.end)
      run.move(change);
    return false;
  };
  moves.edit(spoils);
  endings.edit(spoils);
  quiet.edit(spoils);
}

} // namespace ncvet
