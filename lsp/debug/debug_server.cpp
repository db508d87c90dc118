// The debug adapter: the loop that takes messages.
#include "lsp/debug/debug_server.h"

#include "formats/text/system/system.h"
#include "lsp/debug/debug_session.h"

namespace ncvet::dap {

int serve(int in, int out) {
  // A client that goes away is seen when it is written to.
  system::ignoreBrokenPipes();
  lsp::MessageReader reader(in);
  lsp::MessageWriter writer(out);
  DebugChannel channel(writer);
  DebugSession session(channel);
  std::string body;
  while (!session.isOver() && !writer.isBroken()) {
    const lsp::MessageReader::Result read = reader.read(body);
    if (read == lsp::MessageReader::Result::End)
      break;
    if (read == lsp::MessageReader::Result::Message)
      channel.handle(body);
    else
      channel.complain(body);
  }
  return session.isOver() ? 0 : 1;
}

} // namespace ncvet::dap
