// Looking things up in a loaded dialect: codes by name, addresses as messages write them.
#include "formats/dialect/dialect.h"

#include "formats/dialect/code_name.h"

#include <bit>

namespace ncvet {

CodeIndex Dialect::find(llvm::StringRef name) const {
  if (std::optional<CodeName> parsed = parseCodeName(name))
    return find(parsed->letter, parsed->numberTimesTen);
  for (size_t index = 0; index < codes.size(); ++index)
    if (!codes[index].letter && codes[index].name == name)
      return codes[index].base;
  return noCode;
}

std::string Dialect::addressName(AddressId address) const {
  if (address < 26)
    return std::string(1, char('A' + address));
  switch (address) {
  case commaA:
    return ",A";
  case commaC:
    return ",C";
  case commaR:
    return ",R";
  case variableAddress:
    return "variable";
  case argumentAddress:
    return "argument";
  case keywordAddress:
    return "keyword";
  case noAddress:
    return "number";
  default:
    size_t index = size_t(address - firstNamed);
    return index < addressNames.size() ? addressNames[index] : std::string();
  }
}

std::string Dialect::alternatives(AddressMask mask) const {
  llvm::SmallVector<AddressId, 8> present;
  for (unsigned address = 0; address < addressCount; ++address)
    if (mask & maskOf(AddressId(address)))
      present.push_back(AddressId(address));
  // The absolute word before its increment: "X or U", "Z or W", not "U or X".
  std::stable_sort(present.begin(), present.end(), [this](AddressId left, AddressId right) {
    return addresses[left].kind != AddressKind::Increment &&
           addresses[right].kind == AddressKind::Increment;
  });
  std::string text;
  for (size_t index = 0; index < present.size(); ++index) {
    if (index)
      text += index + 1 == present.size() ? " or " : ", ";
    text += addressName(present[index]);
  }
  return text;
}

double Dialect::lengthsPerUnit(Axis axis) const {
  if (!isLathe()) // on a mill codes say where X is a diameter
    return 1;
  for (AddressMask left = axisWords; left; left &= left - 1) {
    const AddressInfo &address = addresses[size_t(std::countr_zero(left))];
    if (address.kind == AddressKind::Axis && address.axis == axis && address.diameter)
      return 2;
  }
  return 1;
}

} // namespace ncvet
