// Checks of subprograms that are made after those of the programs that call them.
#include "analyzer/cli/postponed_checks.h"

#include "analyzer/cli/call_groups.h"

namespace ncvet::cli {

namespace {

/// So few files that call one another are each followed with all that they call, which takes no
/// time: what is wrong where they call each other in circles is then told of each of them.
constexpr size_t fewFiles = 32;

} // namespace

PostponedChecks::PostponedChecks(std::vector<Job> &jobs, Session &session) : session_(session) {
  std::vector<Job *> postponed;
  for (Job &job : jobs)
    if (job.outcome.postponed)
      postponed.push_back(&job);
  if (postponed.empty())
    return;
  for (const Job &job : jobs)
    if (!job.outcome.postponed && !job.outcome.followed.empty())
      followed_.add(configOf(job), job.outcome);
  groups_ = groupsByCalls(postponed, session);
  inGroup_.resize(groups_.size());
  for (size_t i = 0; i < groups_.size(); ++i)
    for (const Job *job : groups_[i])
      groupOf_[job] = i;
}

const Config *PostponedChecks::configOf(const Job &job) const {
  auto config = session_.configOf(job.source->path());
  if (config)
    return config->get(); // the session keeps it
  llvm::consumeError(config.takeError());
  return nullptr;
}

OuterCalls PostponedChecks::outerCallsOf(const Job &job) const {
  const Config *const config = configOf(job);
  const std::string &path = job.source->path();
  const size_t group = groupOf_.find(&job)->second;
  OuterCalls calls;
  if (groups_[group].size() <= fewFiles)
    return calls;
  FollowedCalls::Blocks blocks;
  followed_.addTo(blocks, config, job.outcome, path);
  inGroup_[group].addTo(blocks, config, job.outcome, path);
  for (const auto &[block, groups] : blocks)
    calls.followed.push_back({block, groups});
  return calls;
}

void PostponedChecks::add(const Job &job) {
  inGroup_[groupOf_.find(&job)->second].add(configOf(job), job.outcome);
}

} // namespace ncvet::cli
