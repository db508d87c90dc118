// Fuzzes the reader of ECS programs: it always gets on, and every block start is a place to begin
// from.
#include "formats/dialect/loader.h"
#include "tests/fuzz/reader_promises.h"

using namespace ncvet;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::shared_ptr<const Dialect> dialect =
      cantFail(loadDialect("ecs", builtinDialects()));
  fuzz::readAll(*dialect, {reinterpret_cast<const char *>(data), size});
  return 0;
}
