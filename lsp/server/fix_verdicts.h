// Which fixes of findings an editor may offer: those that the command line would make.
#pragma once

#include "lsp/server/bindings.h"
#include "lsp/server/checks.h"

#include <map>
#include <mutex>

namespace ncvet::lsp {

/// Tries fixes before they are offered, and remembers of the last check which ones have held what
/// they say: this is asked for at each move of the cursor. Safe for several threads.
class FixVerdicts {
public:
  /// Decides of `problems`, all of `result`. Of a long text the decision takes longer than hover
  /// and completion are to wait: then it is what is given back, to be made on another thread.
  Worker::Task decide(View &view, const std::shared_ptr<const CheckResult> &result,
                      llvm::ArrayRef<const Problem *> problems);
  /// Whether the fix was tried.
  bool knows(const Problem &problem) const;
  /// Whether the fix may be offered; true of one that was not tried.
  bool holds(const Problem &problem) const;
  /// Whether a try takes longer than a user waits for what may be done at the cursor.
  static bool isLong(llvm::StringRef text);

private:
  void decideNow(const CheckJob &job, const SourceFile &file,
                 const std::shared_ptr<const CheckResult> &result,
                 llvm::ArrayRef<const Problem *> tried);

  mutable std::mutex mutex_;
  std::shared_ptr<const CheckResult> result_;
  std::map<const Problem *, bool> verdicts_;
};

} // namespace ncvet::lsp
