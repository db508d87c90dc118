// Motion record: recorded by following the program, compared block by block.
#include "analyzer/check/motion_record.h"

#include "analyzer/trace/trace.h"
#include "formats/text/crash_guard.h"

#include "llvm/ADT/Hashing.h"

#include <map>
#include <set>

namespace ncvet {

class MotionRecorder final : public TraceSink {
public:
  MotionRecorder(MotionRecord &record, const FileUnit &unit) : record_(record), unit_(unit) {}

  void moved(const TracedMove &traced) override {
    if (record_.motions_.size() < MotionRecord::mostMotions)
      add(*traced.unit, traced.begin, hashOf(traced.move));
    else
      tooMany_ = true;
  }

  /// Where the path is lost is part of what happens.
  void lost(const FileUnit &unit, SourceRange where, llvm::StringRef why) override {
    add(unit, where.begin, llvm::hash_value(why));
  }

  bool tooMany() const { return tooMany_; }

private:
  void add(const FileUnit &unit, uint32_t begin, uint64_t hash) {
    record_.motions_.push_back({begin, unit.index.programAt(begin).body, &unit == &unit_, hash});
  }

  static llvm::hash_code hashOf(const Interval &value) {
    constexpr double steps = 1e6; // rounding is no difference
    return value.isConstant() ? llvm::hash_value(int64_t(std::llround(value.value() * steps)))
                              : llvm::hash_value(value.isUnknown());
  }

  static uint64_t hashOf(const Move &move) {
    llvm::hash_code hash = llvm::hash_combine(move.kind, move.machineAxes, move.clockwise,
                                              move.side, move.feedMode, move.spindle);
    for (const Interval &end : move.to)
      hash = llvm::hash_combine(hash, hashOf(end));
    if (move.kind == MoveKind::Arc)
      hash = llvm::hash_combine(hash, move.plane[0], move.plane[1], hashOf(move.centre[0]),
                                hashOf(move.centre[1]), hashOf(move.turns));
    return llvm::hash_combine(hash, hashOf(move.feed), hashOf(move.value));
  }

  MotionRecord &record_;
  const FileUnit &unit_;
  bool tooMany_ = false;
};

MotionRecord MotionRecord::of(Session &session, SourceSet &sources, const SourceFile &file) {
  MotionRecord record;
  record.file_ = &file;
  auto setup = session.setup(file.path().empty() ? file.display() : file.path(), file.text());
  if (!setup) {
    llvm::consumeError(setup.takeError()); // the check has told
    return record;
  }
  const auto crash = runGuarded([&] {
    Project project(sources, setup->dialect, *setup->machine, setup->config->searchFolders,
                    setup->folders);
    FileUnit &unit = project.unit(file);
    MotionRecorder recorder(record, unit);
    trace(project, unit, setup->limits, recorder, TracedPath::Programmed);
    record.known_ = !recorder.tooMany();
  });
  if (crash)
    record.known_ = false;
  return record;
}

bool MotionRecord::sameAs(const MotionRecord &other) const {
  return known_ && other.known_ &&
         std::equal(motions_.begin(), motions_.end(), other.motions_.begin(), other.motions_.end(),
                    [](const Motion &a, const Motion &b) {
                      return a.inFile == b.inFile && a.hash == b.hash;
                    });
}

uint32_t movedOffset(uint32_t offset, llvm::ArrayRef<TextEdit> edits) {
  int64_t shift = 0;
  for (const TextEdit &edit : edits)
    if (edit.range.end <= offset)
      shift += int64_t(edit.text.size()) - int64_t(edit.range.end - edit.range.begin);
  return uint32_t(int64_t(offset) + shift);
}

namespace {

/// Lines of a text that may move as they like, before and after the edits.
struct FreeLines {
  std::set<uint32_t> before, after;

  FreeLines(const LineIndex &old, const LineIndex &now, llvm::ArrayRef<TextEdit> edits)
      : old_(old), now_(now), edits_(edits) {
    for (const TextEdit &edit : edits) {
      add(edit.range.begin, edit.range.end);
      // What was inserted ends where the text after the edit begins.
      const uint32_t end = movedOffset(edit.range.end, edits);
      addLines(after, now_, end - std::min(end, uint32_t(edit.text.size())), end);
    }
  }

  /// The lines of a range of the old text.
  void add(uint32_t begin, uint32_t end) {
    addLines(before, old_, begin, end);
    addLines(after, now_, movedOffset(begin, edits_), movedOffset(end, edits_));
  }

private:
  static void addLines(std::set<uint32_t> &lines, const LineIndex &index, uint32_t begin,
                       uint32_t end) {
    const uint32_t last = index.lineOf(end);
    for (uint32_t line = index.lineOf(begin); line <= last; ++line)
      lines.insert(line);
  }

  const LineIndex &old_, &now_;
  llvm::ArrayRef<TextEdit> edits_;
};

} // namespace

bool MotionRecord::onlyChangesBlocks(const MotionRecord &after, llvm::ArrayRef<TextEdit> edits,
                                     llvm::ArrayRef<SourceRange> changed) const {
  if (!known_ || !after.known_)
    return false;
  const LineIndex &lines = file_->lines(), &linesAfter = after.file_->lines();
  FreeLines free(lines, linesAfter, edits);
  for (const SourceRange &range : changed)
    if (range.file == file_->id())
      free.add(range.begin, range.end);
  // By block: where it is in the text after the edits, and what it moves.
  struct Moves {
    std::vector<uint64_t> hashes;
    bool edited = false; ///< its program was
  };
  std::map<std::pair<bool, uint32_t>, Moves> before, now;
  std::set<uint32_t> editedPrograms;
  for (const Motion &motion : motions_)
    if (motion.inFile && free.before.count(lines.lineOf(motion.begin)))
      editedPrograms.insert(motion.program);
  for (const Motion &motion : motions_)
    if (!motion.inFile || !free.before.count(lines.lineOf(motion.begin))) {
      const uint32_t begin = motion.inFile ? movedOffset(motion.begin, edits) : motion.begin;
      Moves &moves = before[{motion.inFile, begin}];
      moves.hashes.push_back(motion.hash);
      moves.edited = motion.inFile && editedPrograms.count(motion.program);
    }
  for (const Motion &motion : after.motions_)
    if (!motion.inFile || !free.after.count(linesAfter.lineOf(motion.begin)))
      now[{motion.inFile, motion.begin}].hashes.push_back(motion.hash);
  for (const auto &[block, moves] : now)
    if (!before.count(block))
      return false;
  for (const auto &[block, old] : before) {
    const std::vector<uint64_t> &moves = now[block].hashes;
    const bool fewer = old.edited && moves.size() < old.hashes.size();
    if (!fewer && moves != old.hashes)
      return false;
  }
  return true;
}

} // namespace ncvet
