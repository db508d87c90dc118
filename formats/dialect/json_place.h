// The place of a value in a JSON text: looked for only when an error is to be reported.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"

#include <optional>
#include <string>
#include <vector>

namespace ncvet {

/// One step of the path from the document's root to a value: a key or an array index.
struct JsonStep {
  std::string key;
  size_t index = 0;
  bool isIndex = false;
};
using JsonPath = std::vector<JsonStep>;

/// "codes.G83.words.Q", "detect.marks[2].score".
std::string toString(llvm::ArrayRef<JsonStep> path);

/// Byte offset of the key (or array element) at `path`; none when the text has no such place.
/// The text must be valid JSON; on anything else the answer is none or some place, never a crash.
std::optional<size_t> findJsonPlace(llvm::StringRef text, llvm::ArrayRef<JsonStep> path);

/// The texts of the values of top-level keys, found in one pass; none where there is no such key.
std::vector<std::optional<llvm::StringRef>> findJsonMembers(llvm::StringRef text,
                                                            llvm::ArrayRef<llvm::StringRef> keys);
/// The same of one key.
std::optional<llvm::StringRef> findJsonMember(llvm::StringRef text, llvm::StringRef key);

/// Byte offset of a key that its object has already; none when no object has a key twice. As
/// `findJsonPlace` on anything but JSON.
std::optional<size_t> findRepeatedKey(llvm::StringRef text);

/// Line number, from 1.
unsigned lineAt(llvm::StringRef text, size_t offset);

/// Brackets nest deeper than any table needs: such a text is refused before it is parsed, so that
/// no later step has to fear its depth.
bool nestsTooDeep(llvm::StringRef text);

} // namespace ncvet
