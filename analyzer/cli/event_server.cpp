// The language server in WebAssembly, whose messages its host brings.
//
// A host has the functions below by their names. It gives a message to `ncvet_take`, and then calls
// `ncvet_work` as long as that says that there is more to do. Answers are written to standard
// output.
#include "analyzer/cli/event_server.h"

#include "formats/text/system/system.h"
#include "lsp/server/server.h"

#include <algorithm>
#include <limits>

namespace ncvet::cli {

namespace {

std::unique_ptr<lsp::EventServer> server;

} // namespace

void beginEventServer() {
  server = std::make_unique<lsp::EventServer>(system::standardOutput(), NCVET_VERSION);
}

} // namespace ncvet::cli

extern "C" {

/// 1: the command line asked for a server.
int ncvet_serves() { return ncvet::cli::server != nullptr; }

/// Takes the body of a message.
void ncvet_take(const char *body, size_t size) {
  ncvet::cli::server->take(llvm::StringRef(body, size));
}

/// Does a piece of what is to be done. Milliseconds until there is more; -1: until a message comes.
int ncvet_work() {
  const auto until = ncvet::cli::server->work();
  constexpr auto most = std::chrono::milliseconds(std::numeric_limits<int>::max());
  return until ? int(std::min(*until, most).count()) : -1;
}

/// The exit code when the client has said `exit`, else -1.
int ncvet_exit_code() { return ncvet::cli::server->exitCode().value_or(-1); }
}
