// Takes the motions of a trace as moves of a tool path.
#pragma once

#include "analyzer/trace/path_sections.h"
#include "analyzer/trace/trace.h"
#include "formats/text/line_cursor.h"
#include "formats/text/source_set.h"

namespace ncvet {

/// Numbers of the files of a path, in the order in which they come.
class PathFiles {
public:
  explicit PathFiles(const SourceSet &sources) : sources_(&sources) {}

  uint16_t of(FileId file);
  /// Their ids; `unopened`: the set that is in use has not read the file.
  const std::vector<FileId> &ids() const { return ids_; }
  const std::vector<std::string> &paths() const { return paths_; }
  /// From now on ids are those of another set, in which the same paths are the same files.
  void use(const SourceSet &sources);

  static constexpr FileId unopened = FileId(-1);

private:
  /// More programs than a control has levels and a folder has subprograms.
  static constexpr size_t most = 4096;
  const SourceSet *sources_;
  std::vector<FileId> ids_;
  std::vector<std::string> paths_; ///< by number, as the ids
};

/// Motions as moves of a curve.
class CurveWriter {
public:
  using Point = std::array<float, 3>;
  static constexpr Point nowhere{pathUnknown, pathUnknown, pathUnknown};

  CurveWriter(const Dialect &dialect, PathCurve &curve);
  /// Adds a motion; none for what is no motion, no dwell and no tool.
  PathMove *add(const Move &move);
  /// Where the last one has led.
  const Point &at() const { return at_; }
  void setAt(const Point &at) { at_ = at; }

private:
  void goTo(const Move &move, PathMove &next);
  bool addArc(const Move &move);

  PathCurve &curve_;
  std::array<double, 3> lengths_{};
  Point at_ = nowhere;
};

/// Whether both are the same number, or none.
bool isSameNumber(float a, float b);
bool isSamePoint(const CurveWriter::Point &a, const CurveWriter::Point &b);

/// Takes the programmed path with everything that belongs to it.
class PathCollector : public TraceSink {
public:
  /// What it carries from one block to the next, beside the path itself.
  struct Rest {
    CurveWriter::Point at;
    Place others;
    PathChange feed; ///< the last one of the path
    bool hasFeed = false;
    PathSections::Rest sections;
  };

  PathCollector(const Dialect &dialect, ToolPath &path, PathFiles &files, size_t most);

  uint32_t markOf(const Step &step) override;
  void moved(const TracedMove &traced) override;
  void lost(const FileUnit &unit, SourceRange where, llvm::StringRef why) override;

  /// Compensation moves the tool by a radius that is known.
  bool hasCentre() const { return hasCentre_; }
  Rest rest() const;
  /// Goes on where `rest` was left; the path is as it was then.
  void resume(const Rest &rest);
  /// Nothing more is taken.
  void close() { ended_ = cancel = true; }

  std::atomic<bool> cancel = false; ///< there are all, or too many

private:
  void endAt(const FileUnit &unit, uint32_t begin, PathEnd::Kind kind, std::string why);
  void noteFeed(uint32_t number, const Move &move);
  void noteOthers(uint32_t number, const Move &move);

  ToolPath &path_;
  size_t most_;
  CurveWriter writer_;
  PathFiles &files_;
  PathSections sections_;
  LineCursor lines_;
  Place others_;
  bool ended_ = false, hasCentre_ = false;
};

/// Whether a path goes on after both in the same manner: the blocks that follow are the same.
bool goOnAlike(const PathCollector::Rest &before, const PathCollector::Rest &after);

/// Takes where compensation puts the tool.
class CentreCollector : public TraceSink {
public:
  CentreCollector(const Dialect &dialect, ToolPath &path, PathFiles &files, size_t most);

  void moved(const TracedMove &traced) override;
  void lost(const FileUnit & /*unit*/, SourceRange /*where*/, llvm::StringRef /*why*/) override {}

  const CurveWriter::Point &rest() const { return writer_.at(); }
  void resume(const CurveWriter::Point &rest);
  /// Nothing more is taken.
  void close() { cancel = true; }

  std::atomic<bool> cancel = false; ///< there are all, or too many

private:
  ToolPath &path_;
  size_t most_;
  CurveWriter writer_;
  PathFiles &files_;
  LineCursor lines_;
};

} // namespace ncvet
