// Calls of other files by a program whose caller is not known, where many files are checked.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ncvet {

class BodyMemos; // analyzer/flow/body_memos.h

/// A block whose call was followed, and came back.
struct FollowedCall {
  uint32_t block;  ///< where it begins
  uint64_t groups; ///< modal groups that came back as another one, or were set on the way
};

/// In order, those of one file once for each block.
using FollowedCallsOfFiles = std::vector<std::pair<std::string, std::vector<FollowedCall>>>;

/// What a check does with calls of other files. Who calls the program follows them too, in a state
/// that the program may really be in: what is wrong for every caller is wrong there. So where the
/// checks of the callers have followed a call, the check of the program itself need not, and a
/// folder of programs that call one another takes not much more time than the same programs in one
/// file.
struct OuterCalls {
  bool postpones = false;               ///< the check ends at the first of them, and is made later
  std::vector<FollowedCall> followed{}; ///< of the file, in order: they need not be followed again
  /// Paths, in order, of files without conditions that call one another in circles, this file among
  /// them: a call of one of them never ends. Null: there are none.
  std::shared_ptr<const std::vector<std::string>> circle{};
  /// What earlier checks have found out of called programs; null: nothing is shared.
  std::shared_ptr<BodyMemos> bodies{};
  std::optional<uint64_t> work{}; ///< the most that the check may do; none: as much as any

  const FollowedCall *find(uint32_t block) const {
    const auto at = std::lower_bound(
        followed.begin(), followed.end(), block,
        [](const FollowedCall &call, uint32_t begin) { return call.block < begin; });
    return at != followed.end() && at->block == block ? &*at : nullptr;
  }
  bool isInCircle(const std::string &path) const {
    return circle && std::binary_search(circle->begin(), circle->end(), path);
  }
};

} // namespace ncvet
