// Answers what machine profiles say of options.
#include "formats/dialect/machine.h"

namespace ncvet {

std::optional<llvm::StringRef> MachineProfile::option(llvm::StringRef name) const {
  auto found = options.find(name);
  if (found == options.end() || found->second.empty())
    return std::nullopt;
  return llvm::StringRef(found->second);
}

std::optional<double> MachineProfile::number(llvm::StringRef name) const {
  double value = 0;
  std::optional<llvm::StringRef> text = option(name);
  if (!text || text->getAsDouble(value))
    return std::nullopt;
  return value;
}

} // namespace ncvet
