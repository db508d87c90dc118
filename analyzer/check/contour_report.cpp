// The compensated contours of a program, with the largest tool radius for which each stays whole.
#include "analyzer/check/contour_report.h"

#include "analyzer/trace/trace.h"
#include "interp/geometry/contour_fit.h"

#include <map>

namespace ncvet {

namespace {

/// Longer contours than this are cut off here: memory stays bounded.
constexpr size_t mostElements = 200000;

class ContourCollector : public TraceSink {
public:
  explicit ContourCollector(const Dialect &dialect) : dialect_(dialect) {}

  void moved(const TracedMove &traced) override {
    const Move &move = traced.move;
    if (move.kind == MoveKind::Tool || move.kind == MoveKind::End)
      finish();
    if (move.kind > MoveKind::Thread)
      return;
    const Place from = std::exchange(place_, workPlace(move));
    if (!move.side || (open_ && (move.side > 0) != contour_.onLeft)) {
      finish();
    } else if (!open_) { // the path on is no part of the contour
      open_ = true;
      contour_ = {traced.unit, traced.begin, move.side > 0, 0, true, std::nullopt};
    } else {
      add(from, move);
    }
  }
  void lost(const FileUnit &, SourceRange, llvm::StringRef) override { finish(); }

  void finish() {
    if (std::exchange(open_, false) && !elements_.empty()) {
      contour_.elements = elements_.size();
      contour_.largest = largestFit(elements_, contour_.onLeft);
      const auto key = std::pair(contour_.unit->source.id(), contour_.begin);
      const auto [entry, isNew] = contours_.try_emplace(key, contour_);
      CompensatedContour &kept = entry->second;
      if (!isNew && contour_.largest && (!kept.largest || *contour_.largest < *kept.largest))
        kept = contour_;
      kept.whole &= contour_.whole;
    }
    elements_.clear();
  }

  std::vector<CompensatedContour> contours() const {
    std::vector<CompensatedContour> all;
    for (const auto &[place, contour] : contours_)
      all.push_back(contour);
    return all;
  }

private:
  void add(const Place &from, const Move &move) {
    const ContourPlane plane(dialect_, move.plane);
    const auto begin = plane.point(from), end = plane.point(move.to);
    if (begin && end && move.kind != MoveKind::Arc && *begin == *end)
      return; // along the tool's axis
    const auto element = plane.element(from, move);
    if (element && elements_.size() < mostElements)
      elements_.push_back(*element);
    else
      contour_.whole = false;
  }

  const Dialect &dialect_;
  Place place_;
  bool open_ = false;
  CompensatedContour contour_;
  std::vector<ContourElement> elements_;
  std::map<std::pair<FileId, uint32_t>, CompensatedContour> contours_;
};

} // namespace

std::vector<CompensatedContour> compensatedContours(Project &project, FileUnit &unit,
                                                    const AnalysisLimits &limits) {
  ContourCollector collector(project.dialect());
  trace(project, unit, limits, collector, TracedPath::Programmed);
  collector.finish();
  return collector.contours();
}

} // namespace ncvet
