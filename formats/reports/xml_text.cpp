// Text in XML reports.
#include "formats/reports/xml_text.h"

#include "formats/reports/writers.h"

namespace ncvet {

std::string xmlText(llvm::StringRef text) {
  std::string out;
  for (const char byte : oneLine(text)) {
    switch (byte) {
    case '&':
      out += "&amp;";
      break;
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '"':
      out += "&quot;";
      break;
    default:
      out.push_back(byte);
    }
  }
  return out;
}

std::string xmlPath(llvm::StringRef path) {
  std::string out;
  appendDecoded(out, path, Encoding::Utf8);
  return xmlText(out);
}

} // namespace ncvet
