// JSON inside a page, and arrays of numbers inside JSON.
#include "formats/reports/page_json.h"

#include "llvm/Support/Base64.h"

namespace ncvet {

void NumberBytes::addShort(uint32_t value) {
  for (; value >= 0x80; value >>= 7)
    bytes_.push_back(char(value | 0x80));
  bytes_.push_back(char(value));
}

std::string NumberBytes::base64() const { return llvm::encodeBase64(bytes_); }

void writeJsonInPage(llvm::StringRef json, llvm::raw_ostream &out) {
  while (!json.empty()) {
    const size_t at = json.find('<');
    out << json.substr(0, at);
    if (at == llvm::StringRef::npos)
      return;
    out << "\\u003c";
    json = json.substr(at + 1);
  }
}

} // namespace ncvet
