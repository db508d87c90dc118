// A dry run: its thread, and how it is sent on, changed and made again.
#include "lsp/debug/dry_run.h"

#include "analyzer/flow/engine.h"
#include "formats/text/crash_guard.h"

namespace ncvet::dap {

namespace {

/// Blocks executed again in one run: hours at the speed of a dry run. Whoever does not want to wait
/// for the end of a loop stops it.
constexpr uint64_t mostRepeated = 20'000'000'000;

} // namespace

DryRun::DryRun(LoadedProgram &program, Breakpoints &breakpoints, RunSettings settings,
               RunObserver &observer)
    : program_(program), breakpoints_(breakpoints), settings_(std::move(settings)),
      observer_(observer) {
  for (const auto &[name, value] : settings_.variables)
    journal_[1].changes.push_back({name, value});
}

DryRun::~DryRun() { end(); }

void DryRun::start() {
  how_ = settings_.stopOnEntry ? Go::Into : Go::On;
  launch();
}

void DryRun::launch() {
  ending_ = false;
  running_ = true;
  thread_ = std::thread([this] { runThread(); });
}

void DryRun::end() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = stopsEngine_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable())
    thread_.join();
}

bool DryRun::isStopped() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return waits_;
}

void DryRun::go(Go how) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!waits_)
      return;
    if (how != Go::On) // the user wants to see what comes now
      goTo_.reset();
    waits_ = pause_ = false;
    sentOn_ = how;
  }
  wake_.notify_all();
}

void DryRun::goTo(Breakpoints::Place block) {
  if (!isStopped())
    return;
  goTo_ = block;
  goFrom_ = count_;
  go(Go::On);
}

void DryRun::stepBack() {
  if (isStopped())
    replay(std::max<uint64_t>(count_, 2) - 1, 0);
}

void DryRun::goBack() {
  if (isStopped())
    replay(0, count_);
}

/// The same run once more. What the user did at the goal or after it is to be done anew.
void DryRun::replay(uint64_t goal, uint64_t scanTo) {
  end();
  goTo_.reset();
  goal_ = goal;
  scanTo_ = scanTo;
  launch();
}

void DryRun::perform(const std::function<void()> &task) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (running_ && !waits_) {
    task_ = task;
    hasTask_ = true;
    served_.wait(lock, [&] { return !task_ || !running_ || waits_; });
    hasTask_ = false;
    if (!std::exchange(task_, nullptr))
      return;
  }
  task();
}

/// What the other thread wants done while nothing is executed.
void DryRun::serve() {
  if (!hasTask_)
    return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (task_)
      task_();
    task_ = nullptr;
  }
  served_.notify_all();
}

llvm::Error DryRun::assignVariable(llvm::StringRef name, llvm::StringRef value) {
  if (llvm::Error wrong = assign(*frames_.back().unit, *state_, name, value))
    return wrong;
  journal_[count_].changes.push_back({name.str(), value.str()});
  return llvm::Error::success();
}

void DryRun::runThread() {
  runOnce();
  if (scanTo_ && !ending_) { // it is known now where the breakpoint was
    goal_ = std::max<uint64_t>(lastHit_, 1);
    scanTo_ = 0;
    runOnce();
  }
  if (goTo_ && !ending_) {
    tellNotReached();
    goal_ = std::max<uint64_t>(goFrom_, 1);
    goTo_.reset();
    runOnce();
  }
  const bool tells = !ending_;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    running_ = false;
  }
  served_.notify_all();
  if (tells)
    observer_.ended(!lost_);
}

void DryRun::tellNotReached() {
  const SourceFile &source = program_.project().sources().get(goTo_->first);
  observer_.said("important",
                 "the run does not come to line " +
                     std::to_string(source.lines().lineOf(goTo_->second)) + " from here",
                 program_.project().unit(source), goTo_->second);
}

void DryRun::runOnce() {
  count_ = lastHit_ = 0;
  lost_ = false;
  frames_.clear();
  told_.clear();
  breakpoints_.forgetHits();
  AnalysisLimits limits = program_.setup().limits;
  limits.repeatedBlocks = mostRepeated;
  SkipSwitches skip = settings_.skip;
  for (SkipSwitch &one : skip)
    if (one == SkipSwitch::Unknown)
      one = SkipSwitch::Off;
  stopsEngine_ = ending_.load();
  const auto crash = runGuarded([&] {
    Engine engine(program_.project(), program_.main(), limits, &stopsEngine_);
    engine.inFull = true;
    engine.listen(*this);
    engine.follow(skip);
  });
  if (crash)
    observer_.said("stderr", "the run failed: " + *crash, program_.main(), 0);
}

/// Waits until the run is sent on, or ended.
void DryRun::wait(const Stop &stop, MachineState &state) {
  state_ = &state;
  pause_ = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (ending_)
      return;
    waits_ = true;
    sentOn_.reset();
  }
  served_.notify_all();
  observer_.stopped(stop);
  std::unique_lock<std::mutex> lock(mutex_);
  wake_.wait(lock, [&] { return sentOn_ || ending_; });
  waits_ = false;
  how_ = sentOn_.value_or(Go::On);
  depth_ = frames_.size();
}

bool DryRun::stepEnds() const {
  switch (how_) {
  case Go::On:
    return false;
  case Go::Into:
    return true;
  case Go::Over:
    return frames_.size() <= depth_;
  case Go::Out:
    return frames_.size() < depth_;
  }
  return false;
}

void DryRun::applyJournal(MachineState &state) {
  if (goal_ && count_ == goal_) // what comes after it is done anew
    journal_.erase(journal_.upper_bound(goal_), journal_.end());
  const auto noted = journal_.find(count_);
  if (noted == journal_.end())
    return;
  if (goal_ && count_ == goal_)
    noted->second.answer = Truth::Unknown;
  const Frame &frame = frames_.back();
  for (const Change &change : noted->second.changes)
    if (llvm::Error wrong = assign(*frame.unit, state, change.name, change.value))
      observer_.said("stderr", llvm::toString(std::move(wrong)), *frame.unit, frame.begin);
}

/// A block that the run has come to before.
Truth DryRun::comeAgain(const Arrival &arrival, bool entered) {
  if (atBreakpoint(arrival, entered, /*aloud=*/false))
    lastHit_ = count_;
  const auto noted = journal_.find(count_);
  return noted == journal_.end() ? Truth::Unknown : noted->second.answer;
}

Truth DryRun::arrives(const Arrival &arrival) {
  if (stopsEngine_)
    return Truth::Unknown;
  ++count_;
  if (scanTo_ && count_ >= scanTo_) {
    stopsEngine_ = true;
    return Truth::Unknown;
  }
  const bool entered = enter(arrival);
  applyJournal(arrival.state);
  serve();
  answer_ = Truth::Unknown;
  const bool again = scanTo_ || count_ < goal_;
  tellReached(arrival, !again);
  Truth answer = Truth::Unknown;
  if (again) {
    answer = comeAgain(arrival, entered);
  } else {
    tellPassed(arrival);
    isOpen_ = look(arrival);
    std::optional<Stop> stop = whyStop(arrival, entered);
    if (count_ == goal_)
      stop = Stop{"step", "back", "", {}};
    goal_ = 0;
    answer = decide(arrival, std::move(stop));
    if (!ending_)
      tellMessages(arrival, answer);
  }
  last_ = arrival.state;
  state_ = &last_;
  return answer;
}

/// Waits at a stop, and where the state leaves open what the block does until that is decided.
Truth DryRun::decide(const Arrival &arrival, std::optional<Stop> stop) {
  const Stop open{"exception",
                  "unknown",
                  "what decides here is not known: give the variable a value, or answer `yes` (the "
                  "condition holds) or `no`",
                  {}};
  const bool asks = settings_.open == OpenCondition::Ask;
  if (!stop && isOpen_ && (asks || breakpoints_.filters.unknown))
    stop = open;
  while (stop && !ending_) {
    wait(*stop, arrival.state);
    isOpen_ = look(arrival);
    stop.reset();
    if (isOpen_ && asks && answer_ == Truth::Unknown)
      stop = open;
  }
  if (!isOpen_ || ending_)
    return Truth::Unknown;
  if (answer_ == Truth::Unknown)
    answer_ = settings_.open == OpenCondition::Holds ? Truth::Yes : Truth::No;
  journal_[count_].answer = answer_;
  return answer_;
}

void DryRun::pathLost(SourceRange where, llvm::StringRef why) {
  if (stopsEngine_)
    return;
  lost_ = true;
  const FileUnit &unit = program_.project().unit(program_.project().sources().get(where.file));
  observer_.said("important", "the run ends here: " + why.str(), unit, where.begin);
  if (!frames_.empty() && !goTo_)
    wait({"exception", "the run ends here", why.str(), {}}, last_);
}

} // namespace ncvet::dap
