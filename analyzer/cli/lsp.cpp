// `ncvet lsp`: the language server on standard input and output.
#include "analyzer/cli/lsp.h"

#include "analyzer/cli/event_server.h"
#include "formats/text/crash_guard.h"
#include "formats/text/system/system.h"
#include "formats/text/threads.h"
#include "lsp/server/server.h"

namespace ncvet::cli {

LspCommand::LspCommand() : Command("lsp", "serve an editor on standard input and output") {
  options.section("Options");
  options.add("--stdio", &stdio_, "taken because editors give it; there is no other way");
}

int LspCommand::run() {
  enableCrashGuard();
  if (!hasThreads) {
    beginEventServer();
    return exitClean;
  }
  system::keepFreedMemory();
  return lsp::serve(system::standardInput(), system::standardOutput(), NCVET_VERSION);
}

} // namespace ncvet::cli
