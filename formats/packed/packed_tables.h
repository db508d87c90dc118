// The tables that come with the program as bytes: they are made when it is built, so that a start
// reads no JSON.
#pragma once

#include "formats/dialect/config_file.h"
#include "formats/dialect/loader.h"

namespace ncvet {

/// What is known of the built-in controls as a whole.
struct PackedIndex {
  std::vector<DialectSummary> dialects; ///< sorted by id
  DetectFile detection;
  llvm::StringMap<std::vector<std::string>> needed; ///< by pattern of a mark: its `neededTexts`
};
/// Out of the JSON files.
llvm::Expected<PackedIndex> loadIndex();

std::string pack(const Dialect &dialect);
std::string pack(const PackedIndex &index);

/// Of what `pack` made.
std::shared_ptr<Dialect> unpackDialect(llvm::StringRef bytes);
PackedIndex unpackIndex(llvm::StringRef bytes);

/// The controls that can be chosen, by id, and the index, whose name is empty.
llvm::ArrayRef<RulesetFile> packedTables();

} // namespace ncvet
