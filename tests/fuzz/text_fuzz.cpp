// Fuzzes source buffers: positions of any bytes agree with counting by hand, and edits fit
// together.
#include "formats/text/edit.h"
#include "formats/text/source.h"
#include "tests/fuzz/require.h"

#include <cstdint>

namespace {

using ncvet::fuzz::require;

/// Line number by reading every byte: what the index must agree with.
uint32_t countedLine(llvm::StringRef text, uint32_t offset) {
  uint32_t line = 1;
  for (uint32_t i = 0; i < offset; ++i) {
    const bool crlf = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if (text[i] == '\n' || (text[i] == '\r' && !crlf))
      ++line;
  }
  return line;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  using namespace ncvet;
  const llvm::StringRef text(reinterpret_cast<const char *>(data), size);
  const auto file = SourceFile::fromText(0, "fuzz.nc", text);
  const auto end = static_cast<uint32_t>(size);
  // A few places are enough for one input; the fuzzer finds the rest by changing it.
  const uint32_t step = end / 16 + 1;
  for (uint32_t offset = 0; offset <= end; offset += step) {
    const uint32_t line = file->lines().lineOf(offset);
    require(line == countedLine(text, offset));
    const uint32_t begin = file->lines().lineBegin(offset);
    require(begin <= offset);
    require(begin == file->lines().beginOfLine(line));
    require(file->lines().lineEnd(offset) >= begin);
    require(file->position(offset).line == line);
    require(file->position(offset).column >= 1);
    file->displayLine(line);
  }
  TextEdit edit;
  edit.range.begin = end / 3;
  edit.range.end = end / 2;
  edit.text = "G80\n";
  const std::string changed = applyEdits(text, edit);
  require(changed.size() == size - (edit.range.end - edit.range.begin) + edit.text.size());
  return 0;
}
