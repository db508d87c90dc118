// The debug adapter: dry runs of programs for editors.
#pragma once

#include "llvm/ADT/StringRef.h"

namespace ncvet::dap {

/// Serves one client over file descriptors until it disconnects or goes away; the exit code: 0
/// after `disconnect`, else 1.
int serve(int in, int out);

} // namespace ncvet::dap
