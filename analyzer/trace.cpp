// The motions that a program makes, from its first block to its end.
#include "analyzer/trace.h"

#include "analyzer/engine.h"
#include "interp/arc.h"
#include "interp/compensated_path.h"
#include "interp/corner_path.h"
#include "interp/tool_data.h"

#include <utility>

namespace ncvet {

namespace {

/// Makes motions of the blocks that are executed.
class Tracer : public BlockWatcher {
public:
  Tracer(Project &project, FileUnit &unit, TraceSink &sink, TracedPath path)
      : project_(project), sink_(sink), corners_(project.dialect()), path_(project.dialect()) {
    if (path == TracedPath::ToolCentre && !project.dialect().isLathe())
      compensated_.emplace(project.dialect(), outsideCorner(unit));
  }

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
    if (after.compensation == phaseOn) {
      const int8_t side = compensatedSide(*unit.dialect, after);
      const auto radius = compensationRadius(*unit.dialect, unit.machine, after);
      for (Move &move : moves_) {
        move.side = side;
        move.toolRadius = radius;
        move.plane = plane;
      }
    }
    for (const Move &move : moves_)
      path_.add(tag, move, corner, plane,
                [&](uint64_t from, const Move &m) { compensate(from, m); });
  }

  void lost(SourceRange where, llvm::StringRef why) override {
    finish();
    sink_.lost(unitOf(where.file), where, why);
  }

  /// Behind a contour that it ran, the tool goes back to where the cycle began.
  void profileEnds() override { returns_ = std::exchange(ran_, false); }

  void finish() {
    path_.finish([&](uint64_t from, const Move &move) { compensate(from, move); });
    if (compensated_)
      compensated_->finish([&](uint64_t from, const Move &move) { give(from, move); });
  }

private:
  const FileUnit &unitOf(FileId file) { return project_.unit(project_.sources().get(file)); }
  static OutsideCorner outsideCorner(const FileUnit &unit) {
    const auto own = unit.machine.option("outsideCorner");
    const auto usual = unit.dialect->options.find("outsideCorner");
    const llvm::StringRef said = own                                    ? *own
                                 : usual == unit.dialect->options.end() ? llvm::StringRef()
                                                                        : usual->second;
    return said == "lines" ? OutsideCorner::Lines : OutsideCorner::Arc;
  }
  void compensate(uint64_t tag, const Move &move) {
    if (compensated_)
      compensated_->add(tag, move, [&](uint64_t from, const Move &m) { give(from, m); });
    else
      give(tag, move);
  }
  void give(uint64_t tag, const Move &move) {
    sink_.moved({&unitOf(FileId(tag >> 32)), uint32_t(tag), move});
  }

  Project &project_;
  TraceSink &sink_;
  const CornerWords corners_;
  CornerPath path_;
  std::optional<CompensatedPath> compensated_;
  bool ran_ = false;     ///< the blocks at hand are a contour that a cycle runs
  bool returns_ = false; ///< the last blocks were one
  llvm::SmallVector<Move, 16> moves_;
};

} // namespace

void trace(Project &project, FileUnit &unit, const AnalysisLimits &limits, TraceSink &sink,
           TracedPath path) {
  const RuleSelection noRules{std::vector<bool>(allRules().size()),
                              std::vector<bool>(allRules().size()),
                              std::vector<std::optional<Severity>>(allRules().size()),
                              {}};
  Tracer tracer(project, unit, sink, path);
  Engine(project, unit, noRules, limits, nullptr).follow(tracer);
  tracer.finish();
}

} // namespace ncvet
