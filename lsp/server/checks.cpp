// Checks of open documents: when each begins, what ends it, and its findings made ready to be sent.
#include "lsp/server/checks.h"

#include "analyzer/rule/rule_table.h"
#include "formats/finding/plain_message.h"
#include "formats/text/system/system.h"
#include "formats/text/threads.h"
#include "lsp/features/showing/document_states.h"
#include "lsp/transport/rpc.h"

namespace ncvet::lsp {

namespace {

/// A check that takes no longer than a frame of the screen needs no delay.
constexpr double oneFrame = 0.016;
constexpr std::chrono::milliseconds longestDelay(200);
/// So many checks leave so much free memory in pieces that it is worth giving back.
constexpr unsigned checksBetweenTrims = 32;
/// Seconds of the processor after which a check is a long one, whatever else the machine does.
constexpr double longCheck = 0.05;
/// A waiting request looks for its cancellation so often.
constexpr std::chrono::milliseconds patience(20);

Problem problemOf(const Finding &finding, const SourceSet &sources, DiagnosticWriter &writer) {
  const RuleInfo &rule = allRules()[finding.rule].info;
  Problem problem;
  problem.path = sources.get(finding.range.file).path();
  problem.begin = finding.range.begin;
  problem.end = finding.range.end;
  problem.rule = finding.rule;
  problem.diagnostic = writer.diagnostic(finding, rule);
  if (finding.fix) {
    problem.fixTitle = plainMessage(finding.fix->description);
    problem.safe = finding.fix->safety == FixSafety::Safe;
    problem.changes = writer.changes(*finding.fix);
  }
  return problem;
}

/// Once for each document, while nobody waits.
void prepareNext(const CheckJob &job, DocumentMemory &memory) {
  SourceSet sources(job.overlay);
  const SourceFile &file = sources.add(job.document.path, job.document.text, job.document.path);
  const std::lock_guard<std::mutex> lock(memory.mutex);
  if (std::exchange(memory.prepared, true))
    return;
  Recheck first{job.document.text, memory.checks};
  prepareChecks(*job.session, sources, file, first);
}

} // namespace

std::shared_ptr<const CheckResult> check(const CheckJob &job, const std::atomic<bool> *cancel,
                                         CheckMemory *memory) {
  const auto start = std::chrono::steady_clock::now();
  auto result = std::make_shared<CheckResult>();
  result->document = job.document;
  SourceSet sources(job.overlay);
  const SourceFile &file = sources.add(job.document.path, job.document.text, job.document.path);
  std::optional<Recheck> again;
  if (memory)
    again.emplace(Recheck{job.document.text, *memory});
  const FileOutcome outcome =
      checkFile(*job.session, sources, file, cancel, again ? &*again : nullptr);
  if (cancel && *cancel)
    return nullptr;
  result->error = outcome.error;
  result->complete = outcome.complete;
  result->dialect = outcome.dialect;
  result->dialectTitle = outcome.dialectTitle;
  result->reason = outcome.reason;
  result->guessed = outcome.guessed;
  result->sure = outcome.sure;
  DiagnosticWriter writer(sources, job.encoding, job.support, outcome.dialect);
  writer.spell(file.id(), job.document.uri);
  for (const CheckedFinding &checked : outcome.findings)
    if (!checked.finding.suppressed)
      result->problems.push_back(problemOf(checked.finding, sources, writer));
  for (size_t i = 0; i < sources.size(); ++i) {
    const std::string &path = sources.get(FileId(i)).path();
    auto &text = result->files[path];
    if (const auto open = job.overlay->find(path); open != job.overlay->end())
      text = open->second;
  }
  result->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

DocumentStates statesOf(const CheckJob &job, uint32_t offset, const std::atomic<bool> &cancelled) {
  const Document &document = job.document;
  const std::lock_guard<std::mutex> lock(document.memory->mutex);
  return {*job.session, job.overlay, document.path,          document.text,
          offset,       cancelled,   document.memory->checks};
}

Checks::Checks(Done done) : done_(std::move(done)) {
  if (hasThreads)
    thread_ = std::thread([this] { run(); });
}

Checks::~Checks() { stop(); }

void Checks::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    cancel_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable())
    thread_.join();
}

Checks::Clock::duration Checks::delayAfter(double seconds) {
  if (seconds <= oneFrame)
    return {};
  const auto delay = std::chrono::duration<double>(seconds / 2);
  return std::min(std::chrono::duration_cast<Clock::duration>(delay),
                  std::chrono::duration_cast<Clock::duration>(longestDelay));
}

void Checks::schedule(CheckJob job) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    overlay_ = job.overlay;
    const std::string &path = job.document.path;
    const size_t before = waiting_.size();
    waiting_.remove_if([&](const Waiting &other) { return other.job.document.path == path; });
    // Only a text that changes faster than it can be checked has to wait for a pause.
    bool hurried = waiting_.size() != before;
    if (running_ == path) {
      cancel_ = true;
      hurried = true;
    }
    const auto last = results_.find(path);
    const auto delay =
        hurried && last != results_.end() ? delayAfter(last->second->seconds) : Clock::duration();
    waiting_.push_back({std::move(job), Clock::now() + delay});
  }
  changed_.notify_all();
}

void Checks::drop(const std::string &path) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.remove_if([&](const Waiting &other) { return other.job.document.path == path; });
    if (running_ == path)
      cancel_ = true;
    results_.erase(path);
  }
  changed_.notify_all();
}

std::shared_ptr<const CheckResult> Checks::wait(const Document &document,
                                                const std::atomic<bool> &cancelled) {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stopping_ && !cancelled) {
    bool coming = running_ == document.path && runningText_ == document.text.bytes && !cancel_;
    for (Waiting &waiting : waiting_)
      if (waiting.job.document.path == document.path &&
          waiting.job.document.text.bytes == document.text.bytes) {
        waiting.due = Clock::now(); // somebody waits for it
        coming = true;
        changed_.notify_all();
      }
    if (coming) {
      if (hasThreads)
        changed_.wait_for(lock, patience);
      else
        runNext(lock);
      continue;
    }
    const auto known = results_.find(document.path);
    if (known != results_.end() && known->second->document.text.bytes == document.text.bytes)
      return known->second;
    return nullptr;
  }
  return nullptr;
}

std::shared_ptr<const CheckResult> Checks::last(const std::string &path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = results_.find(path);
  return known == results_.end() ? nullptr : known->second;
}

std::optional<Checks::Clock::time_point> Checks::nextDue() const {
  std::optional<Clock::time_point> due;
  for (const Waiting &waiting : waiting_)
    due = std::min(due.value_or(waiting.due), waiting.due);
  return due;
}

void Checks::use(std::shared_ptr<const SourceSet::Overlay> overlay) {
  const std::lock_guard<std::mutex> lock(mutex_);
  overlay_ = std::move(overlay);
}

bool Checks::isOutdated(const CheckJob &job, const CheckResult &result) const {
  return job.overlay != overlay_ && llvm::any_of(result.files, [&](const auto &file) {
           const auto open = overlay_->find(file.first);
           const bool isOpen = open != overlay_->end();
           return file.first != job.document.path &&
                  file.second != (isOpen ? open->second : nullptr);
         });
}

/// Makes a check anew when another text than it has seen came meanwhile, and nobody has seen to
/// that. The lock is held.
void Checks::again(CheckJob job, const std::shared_ptr<const CheckResult> &result) {
  const std::string &path = job.document.path;
  const auto last = results_.find(path);
  const bool isWaiting =
      llvm::any_of(waiting_, [&](const Waiting &other) { return other.job.document.path == path; });
  if (last != results_.end() && last->second == result && !isWaiting && isOutdated(job, *result))
    waiting_.push_back({std::move(job), Clock::now()});
}

void Checks::runNext(std::unique_lock<std::mutex> &lock) {
  const auto next =
      std::min_element(waiting_.begin(), waiting_.end(),
                       [](const Waiting &a, const Waiting &b) { return a.due < b.due; });
  CheckJob job = std::move(next->job);
  job.overlay = overlay_;
  waiting_.erase(next);
  running_ = job.document.path;
  runningText_ = job.document.text.bytes;
  cancel_ = false;
  lock.unlock();
  std::shared_ptr<const CheckResult> result;
  {
    const std::lock_guard<std::mutex> memory(job.document.memory->mutex);
    const double begin = system::secondsOfThread();
    result = check(job, &cancel_, &job.document.memory->checks);
    if (system::secondsOfThread() - begin > longCheck)
      job.document.memory->takesLong = true;
  }
  lock.lock();
  const bool stale = cancel_;
  running_.clear();
  runningText_.reset();
  if (result && !stale) {
    results_[job.document.path] = result;
    lock.unlock();
    done_(result);
    prepareNext(job, *job.document.memory);
    if (++untrimmed_ % checksBetweenTrims == 0)
      system::giveBackFreeMemory();
    lock.lock();
    again(std::move(job), result);
  }
  changed_.notify_all();
}

void Checks::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stopping_) {
    const auto due = nextDue();
    if (!due)
      changed_.wait(lock);
    else if (*due > Clock::now())
      changed_.wait_until(lock, *due);
    else
      runNext(lock);
  }
}

std::optional<Checks::Clock::duration> Checks::doNext() {
  std::unique_lock<std::mutex> lock(mutex_);
  if (const auto due = nextDue(); due && *due <= Clock::now() && !stopping_)
    runNext(lock);
  const auto due = nextDue();
  if (!due || stopping_)
    return std::nullopt;
  return std::max(Clock::duration::zero(), *due - Clock::now());
}

} // namespace ncvet::lsp
