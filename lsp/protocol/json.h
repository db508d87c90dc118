// Plain values of the protocol as JSON: positions, ranges, locations, edits.
#pragma once

#include "formats/text/edit.h"
#include "lsp/protocol/positions.h"

#include "llvm/ADT/ArrayRef.h"
#include <nlohmann/json.hpp>

#include <map>

namespace ncvet::lsp {

using Json = nlohmann::json;

Json toJson(Position position);
/// A `Range` of the text of `positions`.
Json rangeJson(Positions &positions, uint32_t begin, uint32_t end);
inline Json rangeJson(Positions &positions, SourceRange range) {
  return rangeJson(positions, range.begin, range.end);
}
/// `TextEdit`s of one text.
Json editsJson(Positions &positions, llvm::ArrayRef<TextEdit> edits);

/// Throws `Json::exception` when the value has another form.
Position positionOf(const Json &position);
/// Begin and end as offsets, in this order whatever the client says.
std::pair<uint32_t, uint32_t> offsetsOf(Positions &positions, const Json &range);

/// Adds a value to a list, both as text.
void appendJson(std::string &list, llvm::StringRef value);

} // namespace ncvet::lsp
