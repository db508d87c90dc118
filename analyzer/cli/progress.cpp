// Progress: one line on a terminal, rewritten a few times a second.
#include "analyzer/cli/progress.h"

#include "llvm/ADT/SmallString.h"
#include "llvm/Support/Process.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet::cli {

namespace {

constexpr std::chrono::seconds quietAtFirst(1);
constexpr std::chrono::milliseconds pause(200);

} // namespace

Progress::Progress(const char *what, size_t total)
    : what_(what), total_(total), shown_(total > 1 && llvm::sys::Process::StandardErrIsDisplayed()),
      due_((Clock::now() + quietAtFirst).time_since_epoch().count()) {}

Progress::~Progress() {
  if (written_)
    llvm::errs() << "\r\x1b[K";
}

void Progress::step() {
  const size_t done = ++done_;
  if (!shown_)
    return;
  const Clock::rep now = Clock::now().time_since_epoch().count();
  Clock::rep due = due_;
  if (now < due || !due_.compare_exchange_strong(
                       due, now + std::chrono::duration_cast<Clock::duration>(pause).count()))
    return;
  written_ = true;
  llvm::SmallString<64> line;
  llvm::raw_svector_ostream(line) << "\rncvet: " << what_ << ' ' << done << " of " << total_;
  llvm::errs() << line;
}

} // namespace ncvet::cli
