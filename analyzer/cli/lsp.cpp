// `ncvet lsp`: the language server on standard input and output.
#include "analyzer/cli/lsp.h"

#include "formats/text/crash_guard.h"
#include "lsp/server/heap.h"
#include "lsp/server/server.h"

#include <unistd.h>

namespace ncvet::cli {

LspCommand::LspCommand() : Command("lsp", "serve an editor on standard input and output") {
  options.section("Options");
  options.add("--stdio", &stdio_, "taken because editors give it; there is no other way");
}

int LspCommand::run() {
  enableCrashGuard();
  lsp::keepFreedMemory();
  return lsp::serve(STDIN_FILENO, STDOUT_FILENO, NCVET_VERSION);
}

} // namespace ncvet::cli
