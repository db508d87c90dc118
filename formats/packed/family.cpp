// A control and those whose tables it extends.
#include "formats/packed/family.h"

#include "formats/packed/shipped.h"

#include "llvm/ADT/STLExtras.h"

namespace ncvet {

std::vector<std::string> familyOf(llvm::StringRef dialect) {
  static const std::vector<DialectSummary> known = shippedDialects();
  std::vector<std::string> family;
  std::string id = dialect.str();
  while (!id.empty() && !llvm::is_contained(family, id)) {
    family.push_back(id);
    const auto entry = llvm::find_if(known, [&](const auto &one) { return one.id == id; });
    id = entry == known.end() ? "" : entry->extends;
  }
  return family;
}

std::string firstOf(llvm::ArrayRef<std::string> family, llvm::ArrayRef<std::string> list) {
  for (const std::string &id : family)
    if (llvm::is_contained(list, id))
      return id;
  return "";
}

} // namespace ncvet
