// `ncvet lsp`: the language server on standard input and output.
#include "analyzer/cli/lsp.h"

#include "formats/text/crash_guard.h"
#include "lsp/server/heap.h"
#include "lsp/server/server.h"

#include <unistd.h>

namespace ncvet::cli {

namespace cl = llvm::cl;

LspCommand::LspCommand()
    : command_("lsp", "serve an editor on standard input and output"),
      category_("Options of ncvet lsp"),
      stdio_("stdio", cl::desc("Taken because editors give it; there is no other way"),
             cl::sub(command_), cl::cat(category_)) {}

int LspCommand::run() {
  enableCrashGuard();
  lsp::keepFreedMemory();
  return lsp::serve(STDIN_FILENO, STDOUT_FILENO, NCVET_VERSION);
}

} // namespace ncvet::cli
