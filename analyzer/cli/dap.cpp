// `ncvet dap`: the debug adapter on standard input and output.
#include "analyzer/cli/dap.h"

#include "formats/text/crash_guard.h"
#include "formats/text/system/system.h"
#include "lsp/debug/debug_server.h"

namespace ncvet::cli {

DapCommand::DapCommand()
    : Command("dap", "debug a program in an editor on standard input and output") {
  options.section("Options");
  options.add("--stdio", &stdio_, "taken because editors give it; there is no other way");
}

int DapCommand::run() {
  enableCrashGuard();
  return dap::serve(system::standardInput(), system::standardOutput());
}

} // namespace ncvet::cli
