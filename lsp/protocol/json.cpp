// Plain values of the protocol as JSON.
#include "lsp/protocol/json.h"

#include <algorithm>

namespace ncvet::lsp {

Json toJson(Position position) {
  return {{"line", position.line}, {"character", position.character}};
}

Json rangeJson(Positions &positions, uint32_t begin, uint32_t end) {
  const Position from = positions.at(begin); // ascending order is the quick one
  return {{"start", toJson(from)}, {"end", toJson(positions.at(end))}};
}

Json editsJson(Positions &positions, llvm::ArrayRef<TextEdit> edits) {
  Json list = Json::array();
  for (const TextEdit &edit : edits)
    list.push_back({{"range", rangeJson(positions, edit.range)},
                    {"newText", positions.source().displayText(edit.text)}});
  return list;
}

Position positionOf(const Json &position) {
  // Negative numbers and ones that are too large are kept inside the text by what follows.
  const auto number = [&](const char *name) {
    const auto value = position.at(name).get<int64_t>();
    return uint32_t(std::clamp<int64_t>(value, 0, std::numeric_limits<uint32_t>::max() - 1));
  };
  return {number("line"), number("character")};
}

std::pair<uint32_t, uint32_t> offsetsOf(Positions &positions, const Json &range) {
  const uint32_t begin = positions.offset(positionOf(range.at("start")));
  const uint32_t end = positions.offset(positionOf(range.at("end")));
  return {std::min(begin, end), std::max(begin, end)};
}

void appendJson(std::string &list, llvm::StringRef value) {
  if (list.size() == 2) // both brackets
    list.pop_back();
  else
    list.back() = ',';
  list += value;
  list += ']';
}

} // namespace ncvet::lsp
