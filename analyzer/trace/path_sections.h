// Which moves of a tool path are made under the same modes, and which are one operation.
#pragma once

#include "formats/finding/tool_path.h"

#include <map>
#include <tuple>

namespace ncvet {

struct Step;

/// Looks at each block for the modes that a report tells, and divides the path into operations: a
/// new one begins with another tool, and after a cut with a comment on its own line or with another
/// cycle.
class PathSections {
public:
  explicit PathSections(ToolPath &path) : path_(path) {}

  /// What is carried from one block to the next, beside the path itself.
  struct Rest {
    uint32_t setting = 0;    ///< of the last block
    uint32_t operations = 0; ///< how many there are
    int tool = -1;           ///< of the last operation
    std::string cycle;       ///< of the last operation
    bool hasCut = false;     ///< … has cut
    bool isLast = false;     ///< the last block belongs to it
    bool isTold = false;     ///< a move was made under the modes of the last block
    FileId file = 0;         ///< of the last block
    uint32_t next = 0;       ///< offset after it
  };
  Rest rest() const;
  /// Goes on where `rest` was left; the path is as it was then.
  void resume(const Rest &rest);

  /// A block is executed; the result marks its moves.
  uint32_t enter(const Step &step, uint16_t file);
  /// The move number `number` carries the mark.
  void moved(uint32_t number, uint32_t mark, bool isCut);

private:
  using Mark = std::pair<uint32_t, uint32_t>; ///< setting, operation

  void readComments(const Step &step);
  uint32_t indexOf(const PathSetting &setting);
  void divide(const Step &step, uint16_t file, const PathSetting &setting);

  /// More operations than a person looks at: what comes after them belongs to the last one.
  static constexpr size_t mostOperations = 5000;
  /// More different sets of modes than a program has that a person or a CAM system writes.
  static constexpr size_t mostSettings = 100'000;

  ToolPath &path_;
  std::map<std::string, uint32_t> settings_; ///< by all that is in one
  std::vector<Mark> marks_;
  std::string comment_; ///< on its own line, before the current block
  FileId file_ = FileId(-1);
  uint32_t next_ = 0;                ///< offset after the last block
  uint32_t lastCut_ = uint32_t(-1);  ///< operation of the last cut
  uint32_t lastMark_ = uint32_t(-1); ///< of the last move
};

/// Whether operations go on after both in the same manner: the blocks that follow are the same.
bool goOnAlike(const PathSections::Rest &before, const PathSections::Rest &after);

} // namespace ncvet
