// Checks of subprograms that are made after those of the programs that call them.
#pragma once

#include "analyzer/check/followed_calls.h"
#include "analyzer/cli/check_job.h"

namespace ncvet::cli {

/// The jobs whose first check was postponed, see `OuterCalls`. What one of these checks follows
/// counts for later ones of its group alone, so that the same is found whatever the threads do.
class PostponedChecks {
public:
  PostponedChecks(std::vector<Job> &jobs, Session &session);

  /// Each is checked in its order, by one thread.
  const std::vector<std::vector<Job *>> &groups() const { return groups_; }
  OuterCalls outerCallsOf(const Job &job) const;
  /// The job has been checked.
  void add(const Job &job);

private:
  const Config *configOf(const Job &job) const;

  Session &session_;
  FollowedCalls followed_; ///< by the checks that were not postponed
  std::vector<std::vector<Job *>> groups_;
  std::vector<FollowedCalls> inGroup_;
  std::map<const Job *, size_t> groupOf_;
};

} // namespace ncvet::cli
