// Fuzzes the language server with bytes as a client might send them: it answers or complains, and
// ends when the input ends.
#include "lsp/server/server.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

std::string framed(const std::string &body) {
  return "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

/// What most inputs need to come any further: a start, and a document.
std::string opening() {
  return framed(R"({"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}})") +
         framed(R"({"jsonrpc":"2.0","method":"textDocument/didOpen","params":{"textDocument":)"
                R"({"uri":"file:///nowhere/a.nc","languageId":"gcode","version":1,)"
                R"("text":"O1\nT1 M6\nG0 X1.\nG83 X2. Z-1. R1. Q1. F9.\nM98 P2\nM30\n"}}})");
}

} // namespace

/// The first byte says what the rest is: bytes as they are, or bodies of messages, a line each.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size == 0)
    return 0;
  std::string input(reinterpret_cast<const char *>(data) + 1, size - 1);
  if (data[0] % 4 != 0) {
    std::string bodies = opening();
    for (size_t at = 0; at < input.size();) {
      const size_t end = std::min(input.find('\n', at), input.size());
      bodies += framed(input.substr(at, end - at));
      at = end + 1;
    }
    input = std::move(bodies);
  }
  const int in = ::memfd_create("messages", 0), out = ::open("/dev/null", O_WRONLY);
  if (in < 0 || out < 0 || ::write(in, input.data(), input.size()) != ssize_t(input.size()) ||
      ::lseek(in, 0, SEEK_SET) != 0)
    std::abort();
  ncvet::lsp::serve(in, out, "fuzz");
  ::close(in);
  ::close(out);
  return 0;
}
