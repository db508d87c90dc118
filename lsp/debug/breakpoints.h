// Places and conditions at which a dry run stops.
#pragma once

#include "lsp/debug/watched_value.h"

#include <map>
#include <set>

namespace ncvet::dap {

/// What a client says of a breakpoint.
struct BreakpointWish {
  std::string condition;    ///< empty: always
  std::string hitCondition; ///< `3`, `>= 3`, `% 3`; empty: always
  std::string logMessage;   ///< not empty: it writes this, `{..}` evaluated, and does not stop
};

/// How often a breakpoint is passed before it acts.
class HitCount {
public:
  /// An error says that the text is no such count.
  static llvm::Expected<HitCount> parse(llvm::StringRef text);
  bool holds(uint64_t hits) const;

private:
  enum class Kind : uint8_t { Always, Equal, NotEqual, Less, LessEqual, More, MoreEqual, Every };
  Kind kind_ = Kind::Always;
  uint64_t number_ = 0;
};

class Breakpoint {
public:
  /// An error says what is wrong with the conditions or the message.
  static llvm::Expected<Breakpoint> make(const FileUnit &unit, const BreakpointWish &wish, int id);

  int id() const { return id_; }
  bool isLog() const { return !message_.empty(); }
  /// Counts that the run comes here; whether the breakpoint acts in this state.
  bool hit(const MachineState &state);
  /// The message with its values.
  std::string message(const MachineState &state) const;
  /// A run begins anew.
  void forgetHits() { hits_ = 0; }

private:
  explicit Breakpoint(int id) : id_(id) {}
  /// A text, and the value that comes after it.
  struct Piece {
    std::string text;
    std::optional<WatchedValue> value;
  };
  llvm::Error readMessage(const FileUnit &unit, llvm::StringRef text);

  int id_;
  std::optional<WatchedCondition> condition_;
  HitCount count_;
  uint64_t hits_ = 0;
  std::vector<Piece> message_;
};

/// What a run stops at whatever the place.
struct ExceptionFilters {
  bool errors = false, warnings = false; ///< findings
  bool toolChange = false;
  bool programStop = false;
  bool unknown = false; ///< a condition that the run leaves open, though the launch decides it
};

/// All breakpoints of a session.
struct Breakpoints {
  using Place = std::pair<FileId, uint32_t>; ///< begin of a block
  std::map<Place, std::vector<Breakpoint>> atBlocks;
  std::map<std::string, Breakpoint> atPrograms; ///< by name, as `programKeyOf` spells it
  ExceptionFilters filters;

  void forgetHits();
};

/// `O0100`, `o100` and `100` name one program; other names count in capitals.
std::string programKeyOf(llvm::StringRef name);

} // namespace ncvet::dap
