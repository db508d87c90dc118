// The language server: from the first message to the last.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <string>
#include <vector>

namespace ncvet::lsp {

/// Serves a client that writes to the descriptor `in` and reads from `out`, until it says `exit` or
/// goes away. Returns the exit code of the protocol: 0 when it said `shutdown` before, else 1.
int serve(int in, int out, llvm::StringRef version);

/// The methods of the requests that the server answers, in alphabetical order.
std::vector<std::string> answeredRequests();

} // namespace ncvet::lsp
