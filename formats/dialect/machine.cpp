// Answers what machine profiles say of options.
#include "formats/dialect/machine.h"

#include <nlohmann/json.hpp>

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

std::map<std::string, std::string> MachineProfile::names(llvm::StringRef name) const {
  std::map<std::string, std::string> names;
  const std::optional<llvm::StringRef> text = option(name);
  if (!text)
    return names;
  const nlohmann::json object =
      nlohmann::json::parse(text->begin(), text->end(), nullptr, /*allow_exceptions=*/false);
  if (object.is_object())
    for (const auto &[key, value] : object.items())
      if (value.is_string())
        names[key] = value.get<std::string>();
  return names;
}

} // namespace ncvet
