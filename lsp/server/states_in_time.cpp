// The machine's states at blocks of long documents, for questions that must not wait for them.
#include "lsp/server/states_in_time.h"

#include "formats/text/threads.h"

namespace ncvet::lsp {

namespace {

/// What a user does not notice, beside the time that the answer takes by itself.
constexpr std::chrono::milliseconds patienceForStates(30);
/// Blocks of which states are kept: the mouse goes back and forth between a few.
constexpr size_t mostKept = 8;

} // namespace

std::shared_ptr<StatesInTime::Asked> StatesInTime::find(const CheckJob &job,
                                                        uint32_t offset) const {
  for (const std::shared_ptr<Asked> &one : asked_)
    if (one->offset == offset && !one->cancelled && one->job.session == job.session &&
        one->job.overlay == job.overlay && one->job.document.text.bytes == job.document.text.bytes)
      return one;
  return nullptr;
}

StatesInTime::States StatesInTime::at(const CheckJob &job, uint32_t offset,
                                      const std::atomic<bool> &cancelled) {
  if (!hasThreads || !job.document.memory->takesLong)
    return std::make_shared<const DocumentStates>(statesOf(job, offset, cancelled));
  std::unique_lock<std::mutex> lock(mutex_);
  std::shared_ptr<Asked> asked = find(job, offset);
  if (!asked) {
    for (const std::shared_ptr<Asked> &other : asked_) // the user has gone on
      if (!other->isDone)
        other->cancelled = true;
    asked = std::make_shared<Asked>();
    asked->job = job;
    asked->offset = offset;
    asked_.push_front(asked);
    if (asked_.size() > mostKept)
      asked_.pop_back();
    worker_.post([this, asked] { follow(*asked); });
  }
  done_.wait_for(lock, patienceForStates, [&] { return asked->isDone; });
  return asked->states;
}

void StatesInTime::follow(Asked &asked) {
  States states;
  if (!asked.cancelled)
    states =
        std::make_shared<const DocumentStates>(statesOf(asked.job, asked.offset, asked.cancelled));
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!asked.cancelled)
      asked.states = std::move(states);
    asked.isDone = true;
  }
  done_.notify_all();
}

void StatesInTime::cancel(const std::string &path, bool forgets) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const std::shared_ptr<Asked> &one : asked_)
    if (one->job.document.path == path && !one->isDone)
      one->cancelled = true;
  // What was found out holds memory; of a text that is no more nobody asks.
  asked_.remove_if([&](const std::shared_ptr<Asked> &one) {
    return one->job.document.path == path && (forgets || one->isDone);
  });
}

void StatesInTime::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const std::shared_ptr<Asked> &one : asked_)
      one->cancelled = true;
  }
  worker_.stop();
}

} // namespace ncvet::lsp
