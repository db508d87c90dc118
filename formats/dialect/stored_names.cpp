// The names of stored variables that the interpreter and the rules read.
#include "formats/dialect/stored_names.h"

#include "formats/dialect/variable_key.h"

#include <array>

namespace ncvet {

namespace {

constexpr StoredNameInfo names[] = {
    {"_BELOW", "there while the tool's length counts towards minus: the heights of cycles are "
               "reversed"},
    {"_CYLINDER", "diameter round which a rotary axis is wrapped"},
    {"_LEAST_X", "least corner of the volume that the program sets, mm in the work offset"},
    {"_LEAST_Y", "the same in Y"},
    {"_LEAST_Z", "the same in Z"},
    {"_GREATEST_X", "greatest corner of that volume"},
    {"_GREATEST_Y", "the same in Y"},
    {"_GREATEST_Z", "the same in Z"},
    {"_LEAST_ON", "1 while the least corner is guarded"},
    {"_GREATEST_ON", "1 while the greatest corner is guarded"},
    {"_TRAVEL_FROM_X", "start of the travel that the program allows, mm in machine coordinates"},
    {"_TRAVEL_FROM_Y", "the same in Y"},
    {"_TRAVEL_FROM_Z", "the same in Z"},
    {"_TRAVEL_TO_X", "end of that travel"},
    {"_TRAVEL_TO_Y", "the same in Y"},
    {"_TRAVEL_TO_Z", "the same in Z"},
};
constexpr size_t count = std::size(names);
static_assert(count == size_t(StoredName::TravelToZ) + 1);

} // namespace

llvm::ArrayRef<StoredNameInfo> storedNames() { return names; }

uint64_t storedKey(StoredName name) {
  static const std::array<uint64_t, count> keys = [] {
    std::array<uint64_t, count> made{};
    for (size_t i = 0; i < count; ++i)
      made[i] = variableKey(names[i].name);
    return made;
  }();
  return keys[size_t(name)];
}

} // namespace ncvet
