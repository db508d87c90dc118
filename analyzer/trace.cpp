// The motions that a program makes, from its first block to its end.
#include "analyzer/trace.h"

#include "analyzer/engine.h"
#include "interp/arc.h"
#include "interp/corner_path.h"

#include <utility>

namespace ncvet {

namespace {

/// Makes motions of the blocks that are executed.
class Tracer : public BlockWatcher {
public:
  Tracer(Project &project, TraceSink &sink)
      : project_(project), sink_(sink), corners_(project.dialect()), path_(project.dialect()) {}

  void executed(const FileUnit &unit, const Block &block, const Outcome &outcome,
                const MachineState &before, const MachineState &after) override {
    constexpr uint8_t readAsData = 1, run = 2;
    if (before.profile == readAsData)
      return;
    ran_ |= before.profile == run;
    const ExecutedBlock executed{*unit.dialect, unit.machine, block, outcome, before, after};
    moves_.clear();
    if (returns_)
      appendReturn(executed, moves_);
    returns_ = false;
    appendMoves(executed, moves_);
    if (moves_.empty())
      return;
    const CornerRequest corner = corners_.read(executed);
    const std::array<Axis, 2> plane = arcWords(*unit.dialect, after, block).axes;
    const uint64_t tag = uint64_t(unit.source.id()) << 32 | block.begin;
    for (const Move &move : moves_)
      path_.add(tag, move, corner, plane, [&](uint64_t from, const Move &m) { give(from, m); });
  }

  void lost(SourceRange where, llvm::StringRef why) override {
    finish();
    sink_.lost(unitOf(where.file), where, why);
  }

  /// Behind a contour that it ran, the tool goes back to where the cycle began.
  void profileEnds() override { returns_ = std::exchange(ran_, false); }

  void finish() {
    path_.finish([&](uint64_t from, const Move &move) { give(from, move); });
  }

private:
  const FileUnit &unitOf(FileId file) { return project_.unit(project_.sources().get(file)); }
  void give(uint64_t tag, const Move &move) {
    sink_.moved({&unitOf(FileId(tag >> 32)), uint32_t(tag), move});
  }

  Project &project_;
  TraceSink &sink_;
  const CornerWords corners_;
  CornerPath path_;
  bool ran_ = false;     ///< the blocks at hand are a contour that a cycle runs
  bool returns_ = false; ///< the last blocks were one
  llvm::SmallVector<Move, 16> moves_;
};

} // namespace

void trace(Project &project, FileUnit &unit, const AnalysisLimits &limits, TraceSink &sink) {
  const RuleSelection noRules{std::vector<bool>(allRules().size()),
                              std::vector<bool>(allRules().size()),
                              std::vector<std::optional<Severity>>(allRules().size()),
                              {}};
  Tracer tracer(project, sink);
  Engine(project, unit, noRules, limits, nullptr).follow(tracer);
  tracer.finish();
}

} // namespace ncvet
