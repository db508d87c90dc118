// Checks of subprograms that are made after those of the programs that call them.
#pragma once

#include "analyzer/check/followed_calls.h"
#include "analyzer/cli/call_groups.h"

namespace ncvet::cli {

/// The jobs whose first check was postponed, see `OuterCalls`. What one of these checks follows
/// counts for later ones of its group alone, so that the same is found whatever the threads do.
class PostponedChecks {
public:
  PostponedChecks(std::vector<Job> &jobs, Session &session);

  /// Each is checked in its order, by one thread.
  std::vector<std::vector<Job *>> groups() const;
  OuterCalls outerCallsOf(const Job &job);
  /// The job has been checked.
  void add(const Job &job);

private:
  /// Files that call one another, and what their checks have found out so far.
  struct Group : CallGroup {
    FollowedCalls followed{};
    std::map<FollowedCalls::Key, std::shared_ptr<BodyMemos>> bodies{};
    uint64_t work = 0; ///< that was done
  };

  const Config *configOf(const Job &job) const;

  Session &session_;
  FollowedCalls followed_; ///< by the checks that were not postponed
  std::vector<Group> groups_;
  std::map<const Job *, Group *> groupOf_;
};

} // namespace ncvet::cli
