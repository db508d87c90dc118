// Runs of plain moves at feed: what of the state their path depends on.
#include "analyzer/move_run.h"

namespace ncvet {

bool MoveRun::begins(const Dialect &dialect, const MachineState &state,
                     const PlainRun &plain) const {
  // What the moves do to the facts they have done already.
  if (plain.addresses != addresses || !isSettled(plain, state))
    return false;
  // All that the path could depend on must be the same; these it does not know.
  MachineState here = state;
  here.group = entry.group;
  for (const StandardGroup which : plainMoveGroups)
    if (const GroupIndex group = dialect.group(which); group != noGroup)
      here.group[group] = state.group[group];
  here.factsMay = entry.factsMay;
  here.factsMust = entry.factsMust;
  here.tool = entry.tool;
  here.toolOffset = entry.toolOffset;
  here.preselected = entry.preselected;
  here.lengthOffset = entry.lengthOffset;
  here.radiusOffset = entry.radiusOffset;
  here.spindle = entry.spindle;
  here.liveTool = entry.liveTool;
  here.switchMay = entry.switchMay;
  here.switchMust = entry.switchMust;
  here.switchAxes = entry.switchAxes;
  here.speed = entry.speed;
  here.speedLimit = entry.speedLimit;
  here.feed = entry.feed;
  here.cutArea = entry.cutArea;
  here.locals = entry.locals;
  here.commons = entry.commons;
  here.statedMay = entry.statedMay;
  here.statedMust = entry.statedMust;
  if (staysBelow(entry.fedFrom) && staysBelow(state.fedFrom))
    here.fedFrom = entry.fedFrom;
  return equal(here, entry);
}

void MoveRun::carry(MachineState &state) const {
  state.position = position;
  if (!staysBelow(state.fedFrom))
    state.fedFrom = fedFrom;
  for (unsigned i = 0; i < cutArea.size(); ++i)
    state.cutArea[i] = join(state.cutArea[i], cutArea[i]);
}

} // namespace ncvet
