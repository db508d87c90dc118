// The language server in WebAssembly, whose messages its host brings.
#pragma once

namespace ncvet::cli {

/// Begins the server. The host goes on with the functions of event_server.cpp when `main` has
/// returned.
void beginEventServer();

} // namespace ncvet::cli
