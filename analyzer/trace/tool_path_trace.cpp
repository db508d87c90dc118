// The tool path of a program for reports that draw it.
#include "analyzer/trace/tool_path_trace.h"

#include "analyzer/trace/path_collector.h"

namespace ncvet {

namespace {

PathBox boxOf(const Stock &stock, const Dialect &dialect) {
  PathBox box;
  for (unsigned i = 0; i < 3; ++i) {
    const double length = dialect.lengthsPerUnit(Axis(i));
    if (stock.min[i])
      box.min[i] = *stock.min[i] / length;
    if (stock.max[i])
      box.max[i] = *stock.max[i] / length;
  }
  return box;
}

} // namespace

PathMachine pathMachine(const MachineProfile &profile, const Dialect &dialect) {
  PathMachine machine;
  machine.rapid = profile.rapid;
  machine.feedMax = profile.feedMax;
  machine.spindleMax = profile.spindleMax;
  machine.acceleration = profile.number("acceleration");
  machine.toolChange = profile.number("toolChangeTime");
  Stock travel;
  for (unsigned i = 0; i < 3; ++i) {
    travel.min[i] = profile.axes[i].min;
    travel.max[i] = profile.axes[i].max;
  }
  machine.envelope = boxOf(travel, dialect);
  if (profile.stock)
    machine.stock = boxOf(*profile.stock, dialect);
  for (const Stock &clamp : profile.clamps)
    machine.clamps.push_back(boxOf(clamp, dialect));
  for (const auto &[code, place] : profile.offsets)
    for (unsigned i = 0; i < 3; ++i)
      if (place[i])
        machine.offsets[code][i] = *place[i] / dialect.lengthsPerUnit(Axis(i));
  for (const auto &[number, tool] : profile.tools)
    machine.tools[number] = {tool.kind, tool.radius, tool.length};
  return machine;
}

ToolPath traceToolPath(Project &project, FileUnit &unit, const AnalysisLimits &limits,
                       size_t mostMoves) {
  ToolPath path;
  const Dialect &dialect = project.dialect();
  PathFiles files(project.sources());
  files.of(unit.source.id());
  path.lathe = dialect.isLathe();
  path.diameter = dialect.lengthsPerUnit(Axis::X) == 2;
  path.machine = pathMachine(unit.machine, dialect);
  PathCollector programmed(dialect, path, files, mostMoves);
  trace(project, unit, limits, programmed, TracedPath::Programmed, &programmed.cancel);
  if (programmed.hasCentre()) {
    CentreCollector centre(dialect, path, files, mostMoves);
    trace(project, unit, limits, centre, TracedPath::EveryCentre, &centre.cancel);
  }
  path.files = files.ids();
  return path;
}

} // namespace ncvet
