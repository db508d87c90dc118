// The text of a message as a JSON value.
#pragma once

#include "llvm/ADT/StringRef.h"
#include <nlohmann/json.hpp>

namespace ncvet::lsp {

/// Whether arrays and objects nest deeper than any message needs: the parser calls itself for each.
bool nestsTooDeep(llvm::StringRef text);

/// The value of a message's text; a discarded one when it is no JSON, or nests too deep.
nlohmann::json parseMessage(llvm::StringRef text);

} // namespace ncvet::lsp
