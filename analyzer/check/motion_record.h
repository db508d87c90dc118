// Motion record: what a program moves, kept to be compared with what it moves after a fix.
#pragma once

#include "analyzer/setup/session.h"
#include "formats/text/edit.h"

namespace ncvet {

/// Where an offset of the text before the edits is in the text after them; what an edit inserts at
/// the very place comes before it.
uint32_t movedOffset(uint32_t offset, llvm::ArrayRef<TextEdit> edits);

/// The motions of a program in the order in which they happen, as `trace` gives them: where the
/// tool goes as programmed, tools, spindle and dwells.
class MotionRecord {
public:
  /// Follows the main program of the file. Nothing is recorded when the setup of the file fails or
  /// more than `mostMotions` are made.
  static MotionRecord of(Session &session, SourceSet &sources, const SourceFile &file);

  /// Whether the file could be followed.
  bool isKnown() const { return known_; }
  /// Whether exactly the same is moved, whichever lines it is in.
  bool sameAs(const MotionRecord &other) const;
  /// Whether `after` is what is left of this record by a change of the blocks in `changed` (lines
  /// of this record's file; edits in order): all other blocks move as before or, in the programs
  /// that were edited, less: a cycle that is ended there is not run by them any more.
  bool onlyChangesBlocks(const MotionRecord &after, llvm::ArrayRef<TextEdit> edits,
                         llvm::ArrayRef<SourceRange> changed) const;

  /// More are made by programs of gigabytes, whose fixes are not compared.
  static constexpr size_t mostMotions = 20'000'000;

private:
  struct Motion {
    uint32_t begin = 0;   ///< of its block
    uint32_t program = 0; ///< where the body of its program begins
    bool inFile = true;   ///< the block is in the file itself, not in one that it calls
    uint64_t hash = 0;    ///< of all that it is
  };
  friend class MotionRecorder;

  std::vector<Motion> motions_;
  const SourceFile *file_ = nullptr;
  bool known_ = false;
};

} // namespace ncvet
