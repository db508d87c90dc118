// Addresses of a dialect, and the sets of addresses that its table writes.
#include "formats/dialect/dialect_builder.h"
#include "formats/dialect/field.h"
#include "formats/dialect/vocabulary.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

AddressId commaAddress(char letter) {
  return letter == 'A' ? commaA : letter == 'C' ? commaC : letter == 'R' ? commaR : noAddress;
}

} // namespace

void readValue(JsonReader &in, const Shape &, const Json &value, AddressMask &target) {
  target = static_cast<DialectBuilder &>(in).addressSet(value);
}

std::optional<AddressId> DialectBuilder::addressId(const Json &at, llvm::StringRef name) {
  if (name.size() == 1 && name[0] >= 'A' && name[0] <= 'Z')
    return letterAddress(name[0]);
  if (name.size() == 2 && name[0] == ',' && commaAddress(name[1]) != noAddress)
    return commaAddress(name[1]);
  if (name == "#")
    return noAddress;
  if (name == "@") // any variable that gets a value
    return variableAddress;
  for (size_t index = 0; index < dialect_.addressNames.size(); ++index)
    if (dialect_.addressNames[index] == name)
      return AddressId(firstNamed + index);
  fail(at, llvm::Twine("unknown address \"") + name + "\"");
  return std::nullopt;
}

AddressMask DialectBuilder::addressSet(const Json &at, llvm::StringRef text) {
  AddressMask mask = 0;
  while (!text.empty()) {
    size_t length = text[0] == ',' ? 2 : 1;
    if (std::optional<AddressId> address = addressId(at, text.take_front(length)))
      mask |= maskOf(*address);
    text = text.drop_front(std::min(length, text.size()));
  }
  return mask;
}

AddressMask DialectBuilder::addressSet(const Json &value) {
  if (value.is_string())
    return addressSet(value, value.get_ref<const std::string &>());
  AddressMask mask = 0;
  for (const std::string &name : texts(value))
    if (std::optional<AddressId> address = addressId(value, name))
      mask |= maskOf(*address);
  return mask;
}

void DialectBuilder::readAddresses(const Json &value, Dialect &) {
  if (isObject(value))
    for (auto entry = value.begin(); entry != value.end() && !failed(); ++entry)
      readAddress(entry.key(), *entry);
}

void DialectBuilder::readAddress(const std::string &name, const Json &value) {
  if (name.size() > 1 && name[0] != ',') {
    const bool symbol = name.size() == 2 && name[1] == 'n' && llvm::isPrint(name[0]);
    if (!symbol && !llvm::all_of(name, llvm::isAlnum))
      return fail(value, "an address is one letter, a comma and a letter, letters and digits, or a "
                         "character and `n` for its number");
    if (firstNamed + dialect_.addressNames.size() >= variableAddress)
      return fail(value, "too many addresses of several letters");
    dialect_.addressNames.push_back(name);
  }
  const std::optional<AddressId> address = addressId(value, name);
  if (!address || failed())
    return;
  address_ = *address;
  AddressInfo &info = dialect_.addresses[*address];
  readInto(*this, value, addressRecord, info);
  dialect_.lineAngleWords |= info.lineAngle ? maskOf(*address) : 0;
  dialect_.cornerWords |= info.corner ? maskOf(*address) : 0;
  const bool moves = info.kind == AddressKind::Axis || info.kind == AddressKind::Increment;
  if (info.kind == AddressKind::Unknown)
    fail(value, "an address needs its \"kind\"");
  else if (moves != (info.axis != Axis::Count))
    fail(value, moves ? "an axis word needs its \"axis\"" : "only axis words have an \"axis\"");
}

void DialectBuilder::readAddressAction(const Json &value, AddressInfo &) {
  const auto action = choice(&value, "action", addressActionNames());
  AddressMask *const sets[] = {&dialect_.speedLimitWords, &dialect_.orientWords,
                               &dialect_.feedWords, &dialect_.blockFeedWords};
  if (action)
    *sets[*action] |= maskOf(address_);
}

void DialectBuilder::readAddressSwitch(const Json &value, AddressInfo &info) {
  const auto id = text(value);
  const auto index = id ? switchIndex(value, *id) : std::nullopt;
  if (!index)
    return;
  info.switches = uint8_t(*index);
  dialect_.switchWords |= maskOf(address_);
}

void DialectBuilder::readAddressArc(const Json &value, AddressInfo &) {
  enum : size_t { Radius, Angle, Through };
  const auto meaning = choice(&value, "meaning in an arc", arcWordNames());
  if (!meaning)
    return;
  if (*meaning == Radius)
    dialect_.arcRadius = address_;
  else if (*meaning == Angle)
    dialect_.arcAngle = address_;
  else
    dialect_.arcThrough[*meaning - Through] = address_;
}

/// The sets of addresses that readers and rules ask for.
void DialectBuilder::summarizeAddresses() {
  for (unsigned address = 0; address < addressCount; ++address) {
    const AddressMask mask = maskOf(AddressId(address));
    const AddressInfo &info = dialect_.addresses[address];
    const AddressKind kind = info.kind;
    dialect_.known |= kind == AddressKind::Unknown ? 0 : mask;
    dialect_.incrementWords |= kind == AddressKind::Increment ? mask : 0;
    dialect_.elementWords |= kind == AddressKind::Element ? mask : 0;
    dialect_.polarWords |= kind == AddressKind::Polar || kind == AddressKind::Element ? mask : 0;
    dialect_.axisWords |= kind == AddressKind::Axis || kind == AddressKind::Increment ? mask : 0;
    dialect_.whole |= info.unit == AddressUnit::Whole ? mask : 0;
    dialect_.repeatable |= info.repeatable ? mask : 0;
    dialect_.pointAdvised |= info.pointAdvised ? mask : 0;
    dialect_.plain |= kind == AddressKind::Code || kind == AddressKind::Number ? mask : 0;
  }
  dialect_.known |= addresslessWords;
  dialect_.repeatable |= addresslessWords;
  dialect_.plain |= dialect_.axisWords | lettersMask("FS") | addresslessWords;
  dialect_.plain &= ~lettersMask("NOL");
}

} // namespace ncvet
