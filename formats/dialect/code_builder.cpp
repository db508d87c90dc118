// Codes of a dialect out of its merged JSON: names, groups, switches, variants.
#include "formats/dialect/code_name.h"
#include "formats/dialect/dialect_builder.h"
#include "formats/dialect/vocabulary.h"

#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

namespace ncvet {

/// All codes get their place and group before any is read in full: conditions name other codes.
void DialectBuilder::nameCodes(const Json &codes) {
  std::vector<std::pair<uint64_t, std::string>> order; // letter and number, then names
  for (auto entry = codes.begin(); entry != codes.end(); ++entry) {
    std::optional<CodeName> name = parseCodeName(entry.key());
    if (name && toString(*name) != entry.key())
      return fail(*entry, "is written \"" + toString(*name) + "\"");
    if (!name && dialect_.reader == "iso")
      return fail(*entry, "the name of a G or M code is expected");
    order.emplace_back(name ? uint64_t(name->letter) << 32 | name->numberTimesTen : UINT64_MAX,
                       entry.key());
  }
  std::sort(order.begin(), order.end());
  dialect_.codes.reserve(order.size() + order.size() / 4);
  for (const auto &[rank, name] : order)
    nameCode(name, codes[name]);
}

void DialectBuilder::nameCode(const std::string &name, const Json &value) {
  if (!isObject(value))
    return;
  CodeIndex index = CodeIndex(dialect_.codes.size());
  CodeInfo info;
  info.name = name;
  info.base = index;
  info.letter = 0;
  if (std::optional<CodeName> parsed = parseCodeName(name)) {
    info.letter = parsed->letter;
    info.number = uint16_t(parsed->numberTimesTen);
    bool isG = parsed->letter == 'G';
    std::vector<CodeIndex> &table = isG ? dialect_.gTable : dialect_.mTable;
    size_t at = isG ? parsed->numberTimesTen : parsed->numberTimesTen / 10;
    if (!isG && parsed->numberTimesTen % 10)
      return fail(value, "an M code has no decimal");
    if (table.size() <= at)
      table.resize(at + 1, noCode);
    table[at] = index;
  }
  if (!info.letter) // the marks around it are not part of the word
    dialect_.keywords[llvm::StringRef(name).trim("<>").upper()] = index;
  namedCodes_[name] = index;
  dialect_.codes.push_back(std::move(info));
  joinGroup(value, index);
}

void DialectBuilder::joinGroup(const Json &value, CodeIndex index) {
  const Json *name = member(value, "group");
  std::optional<std::string> id = name ? text(*name) : std::nullopt;
  if (!id)
    return;
  std::vector<llvm::StringRef> known;
  for (size_t at = 0; at < dialect_.groups.size(); ++at) {
    GroupInfo &group = dialect_.groups[at];
    known.push_back(group.id);
    if (group.id != *id)
      continue;
    if (group.members.size() == maxGroupMembers)
      return fail(*name, "the group has more than " + llvm::Twine(maxGroupMembers) + " members");
    dialect_.codes[index].group = GroupIndex(at);
    dialect_.codes[index].bit = uint8_t(group.members.size());
    group.members.push_back(index);
    return;
  }
  fail(*name, "unknown group \"" + *id + "\"" + suggest(*id, known));
}

void DialectBuilder::readCodes(const Json &codes, Dialect &) {
  if (!isObject(codes))
    return;
  nameCodes(codes);
  const size_t count = dialect_.codes.size();
  for (size_t index = 0; index < count && !failed(); ++index) {
    const std::string name = dialect_.codes[index].name;
    const Json &value = codes[name];
    dialect_.codes[index] = readCode(value, dialect_.codes[index]);
    if (member(value, "variants"))
      readVariants(name, value, CodeIndex(index));
  }
}

CodeInfo DialectBuilder::readCode(const Json &value, CodeInfo info) {
  code_ = &info;
  readInto(*this, value, codeRecord, info);
  if (!member(value, "switch"))
    switchCoolant(info);
  return info;
}

void DialectBuilder::readNeeds(const Json &value, CodeInfo &info) {
  for (const std::string &need : texts(value)) {
    const auto *known = llvm::find(codeNeedNames(), llvm::StringRef(need));
    if (known == codeNeedNames().end())
      return fail(value, "unknown need \"" + need + "\"; one of feed, speed");
    (known == codeNeedNames().begin() ? info.needsFeed : info.needsSpeed) = true;
  }
}

void DialectBuilder::readFires(const Json &value, CodeInfo &info) {
  info.firesOnEveryBlock = value == "*";
  info.firesInPlane = value == "plane";
  if (!info.firesOnEveryBlock && !info.firesInPlane)
    info.fires = addressSet(value);
}

void DialectBuilder::readOpposite(const Json &value, CodeInfo &info) {
  if (const std::vector<CodeIndex> list = codeList(value); list.size() == 1)
    info.opposite = list.front();
}

void DialectBuilder::readSwitch(const Json &value, CodeInfo &info) {
  readInto(*this, value, switchEffectRecord, info.effect);
}

void DialectBuilder::readSwitchId(const Json &value, SwitchEffect &effect) {
  if (const auto id = text(value))
    if (const auto index = switchIndex(value, *id))
      effect.index = uint8_t(*index);
}

/// A code of coolant that names no switch of its own turns the one of that name.
void DialectBuilder::switchCoolant(CodeInfo &info) const {
  if (info.action != Action::CoolantOn && info.action != Action::CoolantOff)
    return;
  const auto at =
      llvm::find_if(dialect_.switches, [](const SwitchInfo &s) { return s.id == "coolant"; });
  if (at == dialect_.switches.end() || info.effect.index != 0xFF)
    return;
  info.effect.index = uint8_t(at - dialect_.switches.begin());
  info.effect.on = info.action == Action::CoolantOn;
}

void DialectBuilder::readVariants(const std::string &name, const Json &value, CodeIndex base) {
  const Json &list = value["variants"];
  if (!list.is_array())
    return fail(list, "a list of variants is expected");
  const auto key = [](const std::string &text) {
    JsonStep step;
    step.key = text;
    return step;
  };
  JsonStep index;
  index.isIndex = true;
  for (index.index = 0; index.index < list.size() && !failed(); ++index.index)
    readVariant({key("codes"), key(name), key("variants"), index}, value, list[index.index], base);
}

/// A variant is the code's own entry with the variant's keys laid over it.
void DialectBuilder::readVariant(const JsonPath &place, const Json &value, const Json &variant,
                                 CodeIndex base) {
  if (!isObject(variant))
    return;
  const Json *when = member(variant, "when");
  if (!when)
    return fail(variant, "a variant needs \"when\"");
  Variant entry;
  code_ = &dialect_.codes[base];
  readInto(*this, *when, conditionRecord, entry.when);
  Json own = variant;
  own.erase("when");
  Json whole = value;
  whole.erase("variants");
  layOver(whole, std::move(own));
  setOverlay(&whole, place);
  const CodeInfo &original = dialect_.codes[base];
  CodeInfo info;
  info.name = original.name;
  info.letter = original.letter;
  info.number = original.number;
  info.group = original.group;
  info.bit = original.bit;
  info.base = base;
  entry.code = CodeIndex(dialect_.codes.size());
  dialect_.codes.push_back(info);
  if (member(variant, "group")) { // a group of its own, or with null none at all
    dialect_.codes[entry.code].group = noGroup;
    joinGroup(whole, entry.code);
  }
  dialect_.codes[entry.code] = readCode(whole, dialect_.codes[entry.code]);
  dialect_.codes[base].variants.push_back(std::move(entry));
  setOverlay(nullptr);
}

std::vector<CodeIndex> DialectBuilder::codeList(const Json &value) {
  std::vector<CodeIndex> list;
  for (const std::string &name : texts(value)) {
    auto found = namedCodes_.find(name);
    if (found != namedCodes_.end()) {
      list.push_back(found->second);
      continue;
    }
    fail(value, "the table has no code \"" + name + "\"");
  }
  return list;
}

std::vector<std::pair<GroupIndex, uint64_t>>
DialectBuilder::groupStates(llvm::ArrayRef<CodeIndex> codes,
                            std::vector<CodeIndex> &groupless) const {
  std::vector<std::pair<GroupIndex, uint64_t>> states;
  groupless.clear();
  for (CodeIndex code : codes) {
    const CodeInfo &info = dialect_.codes[code];
    if (info.group == noGroup) {
      groupless.push_back(code);
      continue;
    }
    auto same = llvm::find_if(states, [&](const auto &state) { return state.first == info.group; });
    if (same == states.end())
      states.emplace_back(info.group, uint64_t(1) << info.bit);
    else
      same->second |= uint64_t(1) << info.bit;
  }
  return states;
}

} // namespace ncvet
