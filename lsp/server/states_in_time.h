// The machine's states at blocks of long documents, for questions that must not wait for them.
#pragma once

#include "lsp/features/showing/document_states.h"
#include "lsp/server/checks.h"
#include "lsp/server/worker.h"

#include <list>

namespace ncvet::lsp {

/// Documents whose checks take long are followed on a thread of their own. A question waits a
/// little for it, and is answered without the states when they come later; the next question about
/// the block has them. Of other documents, and without threads, they are always known.
class StatesInTime {
public:
  using States = std::shared_ptr<const DocumentStates>;

  /// The states at the block that begins at `offset`; null: not known in time. On the thread of
  /// features.
  States at(const CheckJob &job, uint32_t offset, const std::atomic<bool> &cancelled);
  /// The document has another text: nobody wants to know the states of the one before, and its
  /// check waits for whoever follows it. Safe for several threads, as is `forget`.
  void textChanged(const std::string &path) { cancel(path, /*forgets=*/false); }
  /// The document is closed.
  void forget(const std::string &path) { cancel(path, /*forgets=*/true); }
  void stop();

private:
  /// One block that was asked about.
  struct Asked {
    CheckJob job;
    uint32_t offset = 0;
    std::atomic<bool> cancelled = false;
    bool isDone = false;
    States states; ///< null: it was cancelled
  };
  std::shared_ptr<Asked> find(const CheckJob &job, uint32_t offset) const;
  void follow(Asked &asked);
  void cancel(const std::string &path, bool forgets);

  std::mutex mutex_;
  std::condition_variable done_;
  std::list<std::shared_ptr<Asked>> asked_; ///< the last one first
  Worker worker_;                           // last: it uses all of the above
};

} // namespace ncvet::lsp
