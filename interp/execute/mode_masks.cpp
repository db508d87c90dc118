// Looks up the groups and members that every block is tested against.
#include "interp/execute/mode_masks.h"

#include "formats/dialect/control_facts.h"

namespace ncvet {

ModeMasks::ModeMasks(const Dialect &dialect, const MachineProfile &machine)
    : motion(dialect.group(StandardGroup::Motion)), cycle(dialect.group(StandardGroup::Cycle)),
      units(dialect.group(StandardGroup::Units)), distance(dialect.group(StandardGroup::Distance)),
      polar(dialect.group(StandardGroup::Polar)), language(dialect.group(StandardGroup::Language)),
      diameter(dialect.group(StandardGroup::Diameter)),
      feedMode(dialect.group(StandardGroup::FeedMode)) {
  for (const GroupIndex group : {motion, cycle, units, distance, polar, language, diameter})
    if (group != noGroup)
      everyBlock |= uint64_t(1) << group;
  const auto members = [&](GroupIndex group, Action action) {
    uint64_t mask = 0;
    if (group != noGroup)
      for (const CodeIndex member : dialect.groups[group].members)
        if (dialect.codes[member].action == action)
          mask |= uint64_t(1) << dialect.codes[member].bit;
    return mask;
  };
  cancelled = members(cycle, Action::CycleCancel);
  inch = members(units, Action::Inch);
  metric = members(units, Action::Metric);
  incremental = members(distance, Action::Incremental);
  polarOn = members(polar, Action::PolarOn);
  if (language != noGroup && dialect.groups[language].initial != 0xFF)
    foreign = ((uint64_t(1) << dialect.groups[language].members.size()) - 1) &
              ~(uint64_t(1) << dialect.groups[language].initial);
  diameterOn = members(diameter, Action::DiameterOn);
  diameterAbsolute = members(diameter, Action::DiameterAbsolute);
  if (dialect.facts->feed.inverseTimeInEachBlock) {
    timeOfBlock = members(feedMode, Action::FeedInverseTime);
    if (timeOfBlock)
      everyBlock |= uint64_t(1) << feedMode;
  }
  pointlessIsIncrement = machine.option("decimalPoint") == llvm::StringRef("increment");
}

} // namespace ncvet
