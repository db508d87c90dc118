// The text of a message as a JSON value.
#include "lsp/transport/json_message.h"

namespace ncvet::lsp {

bool nestsTooDeep(llvm::StringRef text) {
  constexpr unsigned deepest = 200;
  unsigned depth = 0;
  bool inString = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\')
        ++i;
      else
        inString = c != '"';
    } else if (c == '"') {
      inString = true;
    } else if (c == '[' || c == '{') {
      if (++depth > deepest)
        return true;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return false;
}

nlohmann::json parseMessage(llvm::StringRef text) {
  if (nestsTooDeep(text))
    return nlohmann::json(nlohmann::json::value_t::discarded);
  return nlohmann::json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions=*/false);
}

} // namespace ncvet::lsp
