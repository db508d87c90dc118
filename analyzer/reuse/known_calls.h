// What called programs have done in an earlier analysis of almost the same text.
#pragma once

#include "analyzer/reuse/recorded_run.h"

#include <map>

namespace ncvet {

/// A body that has run for some state.
struct BodyRun {
  uint32_t start = 0, end = ~0u; ///< see `RunningRegion`; `~0u`: no end of its own
  unsigned kind = 0;
  uint64_t state = 0; ///< hash

  /// A number for all of it.
  uint64_t print() const;
  void move(const TextChange &change);
};

/// A call of the main program, with all that the called program has called in turn. It can be
/// applied again where the text that was looked at is the same, the state is equal in everything
/// that the call reads or sets, and the rules remember the same. No rule reported anything in it.
struct KnownCall {
  explicit KnownCall(FileId file) : run(file) {}

  using Text = std::pair<uint32_t, uint32_t>; ///< begin and end

  BodyRun body;                     ///< the called program itself
  uint32_t next = 0;                ///< block at which the caller goes on
  bool once = false, macro = false; ///< see `CallSite`
  uint64_t skip = 0;                ///< switches of block skip, before it and after it
  StraightRun run;                  ///< the states and what rules remember; no place in the text
  std::vector<Text> texts;          ///< that were executed or looked at
  std::vector<Text> covered;        ///< that were executed
  std::vector<BodyRun> inner;       ///< that ran in it for the first time
  std::vector<BodyRun> recalled;    ///< of which it was known what they do, from before it
  std::vector<int64_t> numbers, programs; ///< that were named as targets
  std::vector<std::string> labels, names;
  uint64_t repeated = 0, steps = 0;       ///< what it cost
  uint64_t workBefore = 0, workAfter = 0; ///< that was not counted yet, see `workDone`
  unsigned stops = 0, forks = 0;

  bool isSpoilt(const TextChange &change) const;
  void move(const TextChange &change, StraightRun::Moved &moved);
};

/// The known calls of one file.
class KnownCalls {
public:
  void clear() {
    calls_.clear();
    count_ = 0;
    isPlain_ = false;
  }
  /// Calls that have seen the changed text are forgotten, those after it move.
  void edit(const TextChange &change, StraightRun::Moved &moved);
  /// A call of the program at `start` after which the block at `next` follows, that `fits`; or
  /// null.
  const KnownCall *find(uint32_t start, uint32_t next,
                        llvm::function_ref<bool(const KnownCall &)> fits) const;
  void insert(KnownCall call);
  /// Bodies that ran in known calls would have been of use elsewhere: from now on only calls
  /// without such are kept.
  void keepPlain();
  bool isPlain() const { return isPlain_; }

private:
  using At = std::pair<uint32_t, uint32_t>; ///< start of the program, and where its caller goes on
  std::map<At, llvm::SmallVector<std::unique_ptr<KnownCall>, 1>> calls_;
  size_t count_ = 0;
  bool isPlain_ = false;
};

} // namespace ncvet
