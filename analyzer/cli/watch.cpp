// `ncvet check --watch`: the check as a whole, again after each change. So a report never differs
// from that of a check of its own, whatever programs, configurations and tables depend on each
// other.
#include "analyzer/cli/watch.h"

#include "analyzer/cli/interrupt.h"
#include "formats/text/failure.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Process.h"

namespace ncvet::cli {

namespace {

using Clock = std::chrono::steady_clock;

/// Between two looks at folders of which nobody tells changes.
constexpr std::chrono::milliseconds shortestPause(500);
/// A look that takes long, on a network or of many files, is taken in a twentieth of the time.
constexpr int pausePerLook = 20;

void clearScreen(const CheckRequest &request) {
  if (request.color && request.shown() && llvm::sys::Process::StandardOutIsDisplayed())
    llvm::outs() << "\x1b[H\x1b[2J";
}

} // namespace

/// For people; a program that reads the reports is left alone.
void Watch::say(const llvm::Twine &what) const {
  if (request_ && request_->forPeople())
    llvm::errs() << what << '\n';
}

void Watch::check() {
  // Before anything is read: what is written meanwhile is a change.
  const llvm::sys::TimePoint<> begin = std::chrono::system_clock::now();
  std::optional<FileStamps> before;
  if (request_)
    before.emplace(*request_, read_);
  auto request = requestFrom(startFolder_);
  if (!request) {
    code_ = fail(request.takeError());
    stamps_ = std::move(before);
    return;
  }
  request_ = *request;
  if (!before)
    before.emplace(*request_, read_);
  // Until the first report there is no code to end with: Ctrl-C ends the process.
  static const std::atomic<bool> never = false;
  CheckRound round{ended_ ? *ended_ : never};
  const int code = runCheck_(std::move(*request), round);
  if (round.cancelled)
    return;
  code_ = code;
  read_ = std::move(round.read);
  before->addRead(FileStamps(*request_, read_), begin);
  stamps_ = std::move(before);
}

/// The request, its options being read in `folder`. `--relative-to` makes another one the current
/// folder, which stays it when the request cannot be made.
llvm::Expected<CheckRequest> Watch::requestFrom(llvm::StringRef folder) const {
  llvm::SmallString<256> shown;
  std::error_code error = llvm::sys::fs::current_path(shown);
  if (!error)
    error = llvm::sys::fs::set_current_path(folder);
  if (error)
    return failure("cannot go to " + folder + ": " + error.message());
  auto request = makeRequest_();
  if (!request && llvm::sys::fs::set_current_path(shown))
    return failure(llvm::toString(request.takeError()) + "; cannot go back to " + shown.str());
  return request;
}

/// Whether something has changed; false: Ctrl-C.
bool Watch::waitForChange() {
  const size_t programs = stamps_->programs();
  say("watching " + llvm::Twine(programs) + (programs == 1 ? " file" : " files") +
      "; Ctrl-C ends it");
  folders_.watch(stamps_->folders());
  for (std::chrono::milliseconds pause(0); !*ended_;) {
    const Clock::time_point begin = Clock::now();
    const std::string changed = FileStamps(*request_, read_).difference(*stamps_);
    if (!changed.empty()) {
      clearScreen(*request_);
      say("changed: " + changed);
      return true;
    }
    pause = std::max(shortestPause, std::chrono::duration_cast<std::chrono::milliseconds>(
                                        (Clock::now() - begin) * pausePerLook));
    folders_.wait(pause, *ended_);
  }
  return false;
}

int Watch::run() {
  llvm::SmallString<256> folder;
  if (const std::error_code error = llvm::sys::fs::current_path(folder))
    return fail("cannot find out the current folder: " + error.message());
  startFolder_ = std::string(folder);
  check();
  if (!stamps_)
    return code_; // the options are wrong
  ended_ = &noteInterrupt();
  // Standard output that was closed is told when the command has ended.
  while (!llvm::outs().has_error() && waitForChange())
    check();
  return code_;
}

} // namespace ncvet::cli
