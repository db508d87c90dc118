// What report writers share: places, and text that is fit for output.
#include "formats/reports/writers.h"

#include "formats/text/json_text.h"

#include "llvm/Support/Path.h"
#include <nlohmann/json.hpp>

#include <algorithm>

namespace ncvet {

const SourceFile &fileOf(const Report &report, const SourceRange &range) {
  return report.sources->get(range.file);
}

LineColumn positionOf(const Report &report, const SourceRange &range) {
  return fileOf(report, range).position(range.begin);
}

Region regionOf(const Report &report, const SourceRange &range) {
  const SourceFile &file = fileOf(report, range);
  const LineColumn begin = file.position(range.begin);
  return {begin, file.position(std::max(range.begin, range.end))};
}

std::string pathFromRoot(const Report &report, llvm::StringRef display) {
  if (llvm::StringRef below = display;
      !report.here.empty() && below.consume_front(report.here) && below.consume_front("/"))
    display = below;
  if (report.folder.empty() || llvm::sys::path::is_absolute(display))
    return display.str();
  llvm::SmallString<128> path = llvm::StringRef(report.folder);
  llvm::sys::path::append(path, display);
  llvm::sys::path::remove_dots(path, /*remove_dot_dot=*/true);
  return llvm::sys::path::convert_to_slash(path);
}

std::string validText(const Report &report, const SourceRange &range, llvm::StringRef text) {
  return isValidUtf8(text) ? text.str() : fileOf(report, range).displayText(text);
}

std::string oneLine(llvm::StringRef text) {
  std::string out;
  out.reserve(text.size());
  for (const char byte : text) {
    const auto code = static_cast<unsigned char>(byte);
    if (code < 0x20)
      appendUtf8(out, 0x2400u + code); // Unicode's pictures of control characters
    else if (code == 0x7F)
      appendUtf8(out, 0x2421);
    else
      out.push_back(byte);
  }
  return out;
}

void dumpJson(const nlohmann::ordered_json &value, llvm::raw_ostream &out) {
  out << jsonText(value);
}

} // namespace ncvet
