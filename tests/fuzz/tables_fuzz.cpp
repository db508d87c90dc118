// Fuzzes what users write as JSON: dialect tables and machine profiles.
#include "formats/dialect/loader.h"

#include <cstdint>
#include <cstdlib>

namespace {
using namespace ncvet;

/// Either a result, or an error that says something.
template <typename T>
void accept(llvm::Expected<T> result) {
  if (!result && llvm::toString(result.takeError()).empty())
    std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size == 0)
    return 0;
  const llvm::StringRef text(reinterpret_cast<const char *>(data) + 1, size - 1);
  static const std::shared_ptr<const Dialect> base =
      cantFail(loadDialect("haas-lathe", builtinDialects()));
  switch (data[0] % 3) {
  case 0:
    accept(parseMachineProfile("machine.json", text));
    break;
  case 1:
    accept(overlay(base, "machine.json", text));
    break;
  default: {
    const DialectSource builtin = builtinDialects();
    accept(loadDialect("own", [&](llvm::StringRef id) {
      return id == "own" ? std::make_optional(std::pair("own.json", text)) : builtin(id);
    }));
  }
  }
  return 0;
}
