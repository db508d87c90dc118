// Fuzzes the trace: any bytes, in any dialect, give motions that end, the same ones each time.
#include "analyzer/trace/trace.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/sessions.h"

#include <cstdint>

namespace {

using namespace ncvet;
using fuzz::require;

/// Counts motions, and adds up what they say.
class Sum : public TraceSink {
public:
  void moved(const TracedMove &traced) override {
    require(traced.unit && traced.begin <= traced.unit->source.text().size());
    ++moves;
    for (const Interval &place : traced.move.to) {
      require(!(place.lo > place.hi));
      known += place.isConstant();
    }
  }
  void lost(const FileUnit &, SourceRange where, llvm::StringRef why) override {
    require(where.begin <= where.end && !why.empty());
    ++losses;
  }
  bool operator==(const Sum &other) const {
    return moves == other.moves && known == other.known && losses == other.losses;
  }

  size_t moves = 0, known = 0, losses = 0;
};

Sum traceOf(Session &session, llvm::StringRef text, TracedPath path, double radius) {
  SourceSet sources;
  // Without a path there is no folder in which called programs could lie.
  const SourceFile &file = sources.add("fuzz.nc", text);
  auto setup = session.setup(file.display(), text);
  require(bool(setup));
  MachineProfile machine = *setup->machine;
  for (int number = 0; radius > 0 && number < 100; ++number)
    machine.tools[number].radius = radius;
  Project project(sources, setup->dialect, std::move(machine));
  Sum sum;
  trace(project, project.unit(file), setup->limits, sum, path);
  return sum;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size == 0)
    return 0;
  const llvm::StringRef text(reinterpret_cast<const char *>(data) + 1, size - 1);
  // The first byte chooses the dialect, and with its upper bits the path and the tools' radius.
  Session &session = fuzz::sessionOf(data[0] & 0x0F);
  const auto path = data[0] & 0x10 ? TracedPath::Programmed : TracedPath::ToolCentre;
  const double radius = (data[0] >> 5 & 3) * 2.5;
  const Sum sum = traceOf(session, text, path, radius);
  if (data[0] & 0x80)
    require(traceOf(session, text, path, radius) == sum);
  return 0;
}
