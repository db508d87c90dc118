// Checks of subprograms that are made after those of the programs that call them.
#include "analyzer/cli/postponed_checks.h"

#include "analyzer/flow/body_memos.h"
#include "analyzer/rule/analysis_limits.h"

namespace ncvet::cli {

namespace {

/// So few files that call one another are each followed with all that they call, which takes no
/// time: what is wrong where they call each other in circles is then told of each of them.
constexpr size_t fewFiles = 32;
/// The work that files which call one another may take together: as much as a few programs.
constexpr uint64_t workOfGroup = 2 * AnalysisLimits().repeatedBlocks;
/// What each of them may take in any case: some thousand blocks.
constexpr uint64_t leastWork = 5000;

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
  for (CallGroup &group : groupsByCalls(postponed, session))
    groups_.push_back({std::move(group)});
  for (Group &group : groups_)
    for (const Job *job : group.jobs)
      groupOf_[job] = &group;
}

std::vector<std::vector<Job *>> PostponedChecks::groups() const {
  std::vector<std::vector<Job *>> all;
  for (const Group &group : groups_)
    all.push_back(group.jobs);
  return all;
}

const Config *PostponedChecks::configOf(const Job &job) const {
  auto config = session_.configOf(job.source->path());
  if (config)
    return config->get(); // the session keeps it
  llvm::consumeError(config.takeError());
  return nullptr;
}

OuterCalls PostponedChecks::outerCallsOf(const Job &job) {
  const Config *const config = configOf(job);
  const std::string &path = job.source->path();
  Group &group = *groupOf_.find(&job)->second;
  OuterCalls calls;
  const uint64_t left = workOfGroup - std::min(workOfGroup, group.work);
  if (left < AnalysisLimits().repeatedBlocks)
    calls.work = std::max(left, leastWork);
  if (group.jobs.size() <= fewFiles)
    return calls;
  FollowedCalls::Blocks blocks;
  followed_.addTo(blocks, config, job.outcome, path);
  group.followed.addTo(blocks, config, job.outcome, path);
  for (const auto &[block, groups] : blocks)
    calls.followed.push_back({block, groups});
  if (const auto circle = group.circles.find(&job); circle != group.circles.end())
    calls.circle = circle->second;
  std::shared_ptr<BodyMemos> &bodies = group.bodies[FollowedCalls::keyOf(config, job.outcome)];
  if (!bodies)
    bodies = std::make_shared<BodyMemos>();
  calls.bodies = bodies;
  return calls;
}

void PostponedChecks::add(const Job &job) {
  Group &group = *groupOf_.find(&job)->second;
  group.followed.add(configOf(job), job.outcome);
  group.work += job.outcome.work;
  for (auto &[of, bodies] : group.bodies)
    if (bodies->isAbandoned()) // what a crash leaves is never given back
      static_cast<void>(
          new std::shared_ptr<BodyMemos>(std::exchange(bodies, std::make_shared<BodyMemos>())));
}

} // namespace ncvet::cli
