// What called bodies have done, by the states in which they began.
#pragma once

#include "analyzer/flow/region.h"
#include "analyzer/reuse/known_calls.h"

#include "llvm/ADT/BitVector.h"

#include <deque>
#include <map>

namespace ncvet {

/// Of one run; or of several runs after each other, of files that call one another: then a body
/// that one of them has followed from a state is not followed again from there by the others.
class BodyMemos {
public:
  /// What a body adds to what only grows.
  struct Added {
    CutArea::Box cut = CutArea::none;
    DepthMoves depth;
  };
  /// What is known of a run of a body besides its exits.
  struct Effect {
    bool stops = false; ///< the program stops in it until the operator goes on
    bool forks = false; ///< something unknown decides in it
    StateUse use;
    llvm::SmallVector<Added, 1> added;                 ///< by exit
    std::optional<std::vector<KnownCall::Text>> texts; ///< that were looked at; none: not known
    unsigned levels = 0;                               ///< of calls in each other that it makes
    llvm::BitVector files;                             ///< that it runs, where runs share memos
  };
  struct Memo {
    uint64_t hash;  ///< of the entry, but for where the tool has cut
    uint64_t print; ///< of the whole entry, where calls are reused
    MachineState entry;
    Exits exits;
    unsigned sections; ///< repeated sections round it
    unsigned depth;    ///< of calls, where it ran
    unsigned run;      ///< that has made it
    Effect effect;

    /// Whether the body does the same in this state.
    bool holdsFor(uint64_t sum, const MachineState &state) const;
    /// What `left`, the state of an exit, is when the body begins in `state`.
    void leadOn(const MachineState &state, size_t exit, MachineState &left) const;
    /// Whether a call in it, made from so deep, is one too many, and was none when it ran.
    bool goesTooDeep(unsigned from, unsigned allowed) const {
      return allowed && from > depth && depth < allowed && from + effect.levels > allowed;
    }
  };
  /// What is remembered of one body.
  struct Remembered {
    std::deque<Memo> memos;
    unsigned known = 0;  ///< more of them in calls that were taken over
    unsigned inVain = 0; ///< runs since one of them was of use

    bool hasRoom() const { return memos.size() + known < most; }
    /// Memos of earlier runs make room for those of this one.
    void makeRoom(unsigned run) {
      while (!hasRoom() && !memos.empty() && memos.front().run != run)
        memos.pop_front();
    }
    void add(Memo memo);

    /// Results of one called program that are remembered.
    static constexpr size_t most = 64;
  };

  /// A further run begins, under this table.
  void begin(const std::shared_ptr<const Dialect> &dialect);
  /// A number for the file of that path.
  unsigned numberOf(llvm::StringRef path) {
    return files_.try_emplace(path, unsigned(files_.size())).first->second;
  }
  Remembered &of(const Region &region) { return bodies_[keyOf(region)]; }
  Remembered &of(const RunningRegion &body) { return bodies_[body]; }
  unsigned run() const { return run_; }
  /// After a crash nothing that is known counts, and it cannot be given back.
  void abandon() { abandoned_ = true; }
  bool isAbandoned() const { return abandoned_; }

private:
  std::map<RunningRegion, Remembered> bodies_;
  std::shared_ptr<const Dialect> dialect_; ///< under which they ran
  llvm::StringMap<unsigned> files_;
  unsigned run_ = 0;
  bool abandoned_ = false;
};

} // namespace ncvet
