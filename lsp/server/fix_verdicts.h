// Which fixes of findings an editor may offer: those that the command line would make.
#pragma once

#include "lsp/server/bindings.h"
#include "lsp/server/checks.h"

#include <map>

namespace ncvet::lsp {

/// Tries fixes before they are offered, and remembers of the last check which ones have held what
/// they say: this is asked for at each move of the cursor. Belongs to the thread of features.
class FixVerdicts {
public:
  /// Decides of `problems`, all of `result`.
  void decide(View &view, Session &session, const std::shared_ptr<const CheckResult> &result,
              llvm::ArrayRef<const Problem *> problems);
  /// Whether the fix may be offered; true of one that was not tried.
  bool holds(const Problem &problem) const;

private:
  std::shared_ptr<const CheckResult> result_;
  std::map<const Problem *, bool> verdicts_;
};

} // namespace ncvet::lsp
