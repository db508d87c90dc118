// Calls that the checks of some files have followed, for the checks of others.
#pragma once

#include "analyzer/check/checker.h"

#include <map>

namespace ncvet {

/// By who was checked: what counts for one control and configuration does not for another.
class FollowedCalls {
public:
  /// Begins of blocks, and what is known of their calls.
  using Blocks = std::map<uint32_t, uint64_t>;
  using Key = std::tuple<const Config *, std::string, bool>;

  /// Who was checked to such an end.
  static Key keyOf(const Config *config, const FileOutcome &outcome) {
    return keyOf(config, outcome, isNarrowed(outcome));
  }
  /// The check of a file under this configuration has come to such an end.
  void add(const Config *config, const FileOutcome &outcome) {
    auto &files = known_[keyOf(config, outcome)];
    for (const auto &[path, calls] : outcome.followed)
      for (const FollowedCall &call : calls)
        files[path][call.block] |= call.groups;
  }

  /// Adds those of the file of which `postponed` is: they need not be followed again.
  void addTo(Blocks &blocks, const Config *config, const FileOutcome &postponed,
             const std::string &path) const {
    for (const bool narrowed : {false, true}) {
      if (narrowed && !isNarrowed(postponed))
        break; // they would have reported less
      const auto files = known_.find(keyOf(config, postponed, narrowed));
      if (files == known_.end())
        continue;
      if (const auto file = files->second.find(path); file != files->second.end())
        for (const auto &[block, groups] : file->second)
          blocks[block] |= groups;
    }
  }

private:
  /// Of a control that is only guessed less is reported.
  static bool isNarrowed(const FileOutcome &outcome) { return outcome.guessed && !outcome.sure; }
  static Key keyOf(const Config *config, const FileOutcome &outcome, bool narrowed) {
    return {config, outcome.dialect, narrowed};
  }

  std::map<Key, std::map<std::string, Blocks>> known_;
};

} // namespace ncvet
