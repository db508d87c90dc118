// Checks of open documents, one after the other on a thread of their own.
#pragma once

#include "analyzer/check/checker.h"
#include "lsp/protocol/diagnostic.h"
#include "lsp/server/documents.h"

#include <chrono>
#include <condition_variable>
#include <list>
#include <optional>
#include <thread>

namespace ncvet::lsp {

class DocumentStates; // lsp/features/showing/document_states.h

/// One finding, ready to be sent. It may lie in another file than the one that was checked.
struct Problem {
  std::string path;
  uint32_t begin = 0, end = 0; ///< offsets in the text of that file
  RuleId rule = 0;
  std::string diagnostic; ///< `Diagnostic` as JSON: most are sent, few are looked into
  std::string fixTitle;   ///< empty: there is no fix
  bool safe = false;
  std::string changes; ///< edits of the fix by URI, as JSON
};

/// What a check of one version of a document gave.
struct CheckResult {
  Document document;
  std::vector<Problem> problems;
  /// Every file that was looked at with the text that the editor had of it; null: the one on disk.
  std::map<std::string, std::shared_ptr<const std::string>> files;
  std::string error;        ///< not empty: it could not be checked
  std::string dialect;      ///< id of the control
  std::string dialectTitle; ///< its name
  std::string reason;       ///< why this control
  bool guessed = false;     ///< nobody named it
  bool sure = false;        ///< of the guess
  bool complete = true;
  double seconds = 0;
};

/// What a check needs; all of it is held by the job alone.
struct CheckJob {
  Document document;
  std::shared_ptr<Session> session;
  std::shared_ptr<const SourceSet::Overlay> overlay;
  PositionEncoding encoding = PositionEncoding::Utf16;
  DiagnosticSupport support;
};

/// Checks one version of a document, on the caller's thread; null when it was cancelled. `memory`,
/// when given, is that of the document's earlier versions.
std::shared_ptr<const CheckResult> check(const CheckJob &job, const std::atomic<bool> *cancel,
                                         CheckMemory *memory = nullptr);

/// The states at the block of an open document that begins at `offset`, on the caller's thread. It
/// waits for a check of the document that is running.
DocumentStates statesOf(const CheckJob &job, uint32_t offset, const std::atomic<bool> &cancelled);

/// Checks documents when they change. A newer version of a document takes the place of the older
/// one, whose check is ended. Checks begin at once; where a text changes faster than it can be
/// checked, they wait until typing pauses.
class Checks {
public:
  using Done = std::function<void(std::shared_ptr<const CheckResult>)>;

  /// `done` is told of every check that was finished, on the thread of the checks.
  explicit Checks(Done done);
  ~Checks();

  void schedule(CheckJob job);
  /// The editor has these texts now: checks that have looked at other ones meanwhile are made
  /// again.
  void use(std::shared_ptr<const SourceSet::Overlay> overlay);
  /// The document is closed.
  void drop(const std::string &path);
  /// Waits for the check of this text, which has been scheduled; null when a newer one took its
  /// place, it was dropped, or `cancelled` is set.
  std::shared_ptr<const CheckResult> wait(const Document &document,
                                          const std::atomic<bool> &cancelled);
  /// What the last finished check of a path gave; null: there was none.
  std::shared_ptr<const CheckResult> last(const std::string &path);
  void stop();
  using Clock = std::chrono::steady_clock;
  /// Without threads: does the next check if it is time. How long it is until the one after it;
  /// none: nothing waits.
  std::optional<Clock::duration> doNext();

private:
  struct Waiting {
    CheckJob job;
    Clock::time_point due;
  };
  void run();
  /// Whether a file that the check looked at has another text by now. The lock is held.
  bool isOutdated(const CheckJob &job, const CheckResult &result) const;
  void again(CheckJob job, const std::shared_ptr<const CheckResult> &result);
  /// When the next check may begin; none: nothing waits. The lock is held.
  std::optional<Clock::time_point> nextDue() const;
  /// Does the check that is due first. The lock is held before and after, not meanwhile.
  void runNext(std::unique_lock<std::mutex> &lock);
  static Clock::duration delayAfter(double seconds);

  Done done_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Waiting> waiting_;
  std::shared_ptr<const SourceSet::Overlay> overlay_; ///< the last one
  std::string running_; ///< path of the document that is being checked; empty: none
  std::shared_ptr<const std::string> runningText_;
  std::atomic<bool> cancel_ = false;
  bool stopping_ = false;
  unsigned untrimmed_ = 0; ///< checks since free memory was given back
  std::map<std::string, std::shared_ptr<const CheckResult>> results_; ///< the last of each path
  std::thread thread_; // last: it uses all of the above
};

} // namespace ncvet::lsp
