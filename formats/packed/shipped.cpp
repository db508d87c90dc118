// Looks up the packed tables.
#include "formats/packed/shipped.h"

#include "formats/packed/packed_tables.h"

namespace ncvet {

namespace {

std::optional<llvm::StringRef> packedTable(llvm::StringRef name) {
  for (const RulesetFile &file : packedTables())
    if (file.name == name)
      return file.text;
  return std::nullopt;
}

const PackedIndex &index() {
  static const PackedIndex made = unpackIndex(packedTable("").value_or(""));
  return made;
}

} // namespace

llvm::Expected<std::shared_ptr<const Dialect>> loadShipped(llvm::StringRef id) {
  if (const auto bytes = id.empty() ? std::nullopt : packedTable(id))
    return unpackDialect(*bytes);
  return loadDialect(id, builtinDialects()); // a base of others, or none at all
}

const std::vector<DialectSummary> &shippedDialects() { return index().dialects; }

const DetectFile &shippedDetection() { return index().detection; }

const llvm::StringMap<std::vector<std::string>> &shippedNeededTexts() { return index().needed; }

} // namespace ncvet
