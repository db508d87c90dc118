// The language server: from the first message to the last.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ncvet::lsp {

/// Serves a client that writes to the descriptor `in` and reads from `out`, until it says `exit` or
/// goes away. Returns the exit code of the protocol: 0 when it said `shutdown` before, else 1.
int serve(int in, int out, llvm::StringRef version);

/// A server for a program without threads, in which messages are events. It writes to `out`, as
/// `serve` does.
class EventServer {
public:
  EventServer(int out, llvm::StringRef version);
  ~EventServer();

  /// Takes a message: a body without its header.
  void take(llvm::StringRef body);
  /// Does a piece of what is to be done. How long it is until there is more; none: until a message
  /// comes.
  std::optional<std::chrono::milliseconds> work();
  /// The exit code of the protocol, when the client has said `exit`.
  std::optional<int> exitCode() const;

private:
  std::unique_ptr<class Server> server_;
};

/// The methods of the requests that the server answers, in alphabetical order.
std::vector<std::string> answeredRequests();

} // namespace ncvet::lsp
