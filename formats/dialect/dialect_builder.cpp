// Groups, switches, limits and rule settings of a dialect out of its merged JSON.
#include "formats/dialect/dialect_builder.h"

#include "formats/dialect/variable_key.h"
#include "formats/dialect/vocabulary.h"
#include "formats/text/json_text.h"

#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

namespace ncvet {

std::string optionText(const Json &value) {
  if (value.is_null())
    return {};
  if (value.is_string())
    return value.get<std::string>();
  if (value.is_number()) { // 1 and 1.0 are the same option
    char text[32];
    snprintf(text, sizeof text, "%.12g", value.get<double>());
    return text;
  }
  return jsonText(value);
}

void DialectBuilder::build() {
  dialect_.standard.fill(noGroup);
  dialect_.facts = std::make_shared<ControlFacts>();
  readInto(*this, root_, dialectRecord, dialect_);
  summarizeAddresses();
  summarizeCodes();
  summarizeToolRadius();
  if (!failed())
    readInitialStates();
}

/// The keys of the variables that hold the radius of a tool.
void DialectBuilder::summarizeToolRadius() {
  constexpr unsigned usual = 100; // numbers of tools and offsets
  ToolRadiusSource &source = dialect_.toolRadius;
  source.places.clear();
  source.allowanceKey = variableKey(source.allowance);
  llvm::SmallVector<llvm::StringRef, 2> names;
  llvm::StringRef(source.variable).split(names, '|', -1, /*KeepEmpty=*/false);
  for (const llvm::StringRef name : names) {
    ToolRadiusSource::Place &place = source.places.emplace_back();
    place.name = name.str();
    place.isList = name.contains('[');
    place.isPlain = !name.contains('{');
    place.key = variableKey(name.split('[').first);
    const auto [before, from] = name.split('{');
    const llvm::StringRef after = from.split('}').second;
    if (!place.isPlain && !after.contains('{'))
      for (unsigned number = 0; number < usual; ++number)
        place.keys.push_back(variableKey((before + llvm::Twine(number) + after).str()));
  }
}

/// What the codes say of the control as a whole.
void DialectBuilder::summarizeCodes() {
  bool lengthByTool = false;
  read(root_, "toolChangeGivesLength", lengthByTool);
  for (CodeInfo &code : dialect_.codes) {
    for (const WordSpec &word : code.words)
      dialect_.pointAdvised |= word.pointAdvised.value_or(false) ? word.any : 0;
    dialect_.callsModally |= code.action == Action::MacroModal || code.cancelsCalls;
    code.isProgram = !code.letter && llvm::any_of(dialect_.hiddenPrograms, [&](const auto &begin) {
      return llvm::StringRef(code.name).startswith(begin);
    });
    if (lengthByTool && code.action == Action::LengthOff)
      dialect_.lengthByTool = code.group;
  }
  if (!dialect_.builderMacros.empty()) {
    dialect_.builderMacro = dialect_.find(dialect_.builderMacros);
    if (dialect_.builderMacro == noCode)
      fail(*member(root_, "builderMacros"), "this code is not in the table");
  }
  VariableRanges &ranges = dialect_.variableRanges;
  ranges.units = dialect_.group(StandardGroup::Units);
  if (ranges.units != noGroup)
    for (const CodeIndex member : dialect_.groups[ranges.units].members)
      if (dialect_.codes[member].action == Action::Inch)
        ranges.inch |= uint64_t(1) << dialect_.codes[member].bit;
  showVariables();
}

/// Variables that hold a part of the state.
void DialectBuilder::readShown(const Json &value, Dialect &dialect) {
  using Part = ShownVariable::Part;
  if (!isObject(value))
    return;
  dialect.shown = std::make_shared<ShownVariables>();
  for (auto entry = value.begin(); entry != value.end(); ++entry) {
    const std::optional<std::string> part = text(*entry);
    if (!part)
      return;
    ShownVariable &variable = dialect.shown->emplace_back();
    variable.key = controlVariableKey(entry.key());
    constexpr llvm::StringLiteral onMachine = "machine-", axes = "xyzabcuvw";
    variable.part = *part == "tool"    ? Part::Tool
                    : *part == "feed"  ? Part::Feed
                    : *part == "speed" ? Part::Speed
                                       : Part::PlaceOnMachine;
    if (variable.part != Part::PlaceOnMachine)
      continue;
    llvm::StringRef axis = *part;
    const size_t index = axis.consume_front(onMachine) && axis.size() == 1 ? axes.find(axis[0])
                                                                           : llvm::StringRef::npos;
    if (index == llvm::StringRef::npos)
      return fail(*entry, "\"tool\", \"feed\", \"speed\" or \"machine-x\" is expected");
    variable.value = double(index);
  }
}

/// Variables that say which code is in force, with those that hold a part of the state.
void DialectBuilder::showVariables() {
  for (const CodeInfo &code : dialect_.codes)
    for (const auto &[key, value] : code.shows) {
      if (!dialect_.shown)
        dialect_.shown = std::make_shared<ShownVariables>();
      dialect_.shown->push_back(
          {key, ShownVariable::Part::Code, code.group, uint64_t(1) << code.bit, value});
    }
  if (!dialect_.shown)
    return;
  llvm::stable_sort(*dialect_.shown, [](const auto &a, const auto &b) { return a.key < b.key; });
  dialect_.variableRanges.shown = dialect_.shown.get();
  dialect_.variableRanges.zeros = dialect_.zeros;
}

void DialectBuilder::readInitialStates() {
  const Json *table = member(root_, "groups");
  if (!table)
    return;
  for (GroupInfo &group : dialect_.groups) {
    const Json *initial = member((*table)[group.id], "initial");
    if (!initial)
      continue;
    for (CodeIndex code : codeList(*initial)) {
      if (!llvm::is_contained(group.members, code))
        fail(*initial, dialect_.codes[code].name + " is not a member of this group");
      group.initial = dialect_.codes[code].bit;
    }
  }
}

void DialectBuilder::readOptions(const Json &value, Dialect &dialect) {
  if (isObject(value))
    for (auto entry = value.begin(); entry != value.end(); ++entry)
      dialect.options[entry.key()] = optionText(*entry);
}

void DialectBuilder::readLexical(const Json &value, Dialect &dialect) {
  readInto(*this, value, lexicalRecord, dialect.lexical);
  const AddressMask comma = dialect.lexical.commaAddresses;
  if (comma & ~(maskOf(commaA) | maskOf(commaC) | maskOf(commaR)))
    fail(*member(value, "commaAddresses"), "only \",A\", \",C\" and \",R\" are known");
  for (unsigned address = commaA; address <= commaR; ++address)
    if (comma & maskOf(AddressId(address))) {
      AddressInfo &info = dialect.addresses[address];
      info.kind = AddressKind::Parameter;
      info.unit = address == commaA ? AddressUnit::Angle : AddressUnit::Length;
    }
}

void DialectBuilder::readProgramDigits(const Json &value, Limits &limits) {
  if (!value.is_array() || value.size() != 2)
    return fail(value, "a list of the least and the greatest number is expected");
  if (const auto least = whole(&value[0], 1, 20))
    limits.programDigitsMin = uint16_t(*least);
  if (const auto most = whole(&value[1], 0, 20))
    limits.programDigitsMax = uint16_t(*most);
}

void DialectBuilder::readSwitches(const Json &value, Dialect &dialect) {
  if (!isObject(value))
    return;
  for (auto entry = value.begin(); entry != value.end(); ++entry) {
    SwitchInfo &info = dialect.switches.emplace_back();
    info.id = info.title = entry.key();
    readInto(*this, *entry, switchRecord, info);
    if (info.blocksAreData && dialect.switches.size() <= maxSwitches)
      dialect.dataSwitches |= 1u << (dialect.switches.size() - 1);
  }
  if (dialect.switches.size() > maxSwitches)
    fail(value, "more than " + llvm::Twine(maxSwitches) + " switches");
}

std::optional<size_t> DialectBuilder::switchIndex(const Json &at, llvm::StringRef id) {
  std::vector<llvm::StringRef> known;
  for (size_t index = 0; index < dialect_.switches.size(); ++index) {
    if (dialect_.switches[index].id == id)
      return index;
    known.push_back(dialect_.switches[index].id);
  }
  fail(at, "unknown switch \"" + id + "\"" + suggest(id, known));
  return std::nullopt;
}

void DialectBuilder::readGroups(const Json &value, Dialect &dialect) {
  if (!isObject(value))
    return;
  if (value.size() > maxGroups)
    return fail(value, "more than " + llvm::Twine(maxGroups) + " groups");
  for (auto entry = value.begin(); entry != value.end(); ++entry) {
    GroupInfo &group = dialect.groups.emplace_back();
    group.id = group.title = entry.key();
    readInto(*this, *entry, groupRecord, group);
    for (size_t index = 0; index < standardGroupNames().size(); ++index)
      if (standardGroupNames()[index] == group.id)
        dialect.standard[index] = GroupIndex(dialect.groups.size() - 1);
  }
}

/// The group, which is the last one so far, is others with a meaning of their own too.
void DialectBuilder::readActsAs(const Json &value, GroupInfo &) {
  for (const std::string &other : texts(value))
    for (size_t index = 0; index < standardGroupNames().size(); ++index)
      if (standardGroupNames()[index] == other)
        dialect_.standard[index] = GroupIndex(dialect_.groups.size() - 1);
}

void DialectBuilder::readFacts(const Json &value, Dialect &dialect) {
  auto facts = std::make_shared<ControlFacts>();
  readInto(*this, value, factRecord, *facts);
  dialect.facts = std::move(facts);
}

std::optional<OptionValue> readOptionValue(JsonReader &in, const Json &value) {
  if (value.is_boolean())
    return double(value.get<bool>());
  if (value.is_number())
    return value.get<double>();
  if (value.is_string())
    return value.get<std::string>();
  in.fail(value, "true, false, a number or a name is expected");
  return std::nullopt;
}

void DialectBuilder::readRules(const Json &value, Dialect &dialect) {
  if (!isObject(value))
    return;
  for (auto entry = value.begin(); entry != value.end() && !failed(); ++entry) {
    RuleOverride &rule = dialect.rules[entry.key()];
    readInto(*this, *entry, ruleRecord, rule);
    if (failed())
      return;
    for (auto option = entry->begin(); option != entry->end(); ++option)
      if (!isFieldOf(ruleRecord, option.key()))
        if (const std::optional<OptionValue> given = readOptionValue(*this, *option))
          rule.options[option.key()] = *given;
  }
}

void DialectBuilder::readDetect(const Json &value, Dialect &dialect) {
  readDetection(*this, value, dialect.detect, dialect.extensions);
}

void readDetection(JsonReader &in, const Json &detect, std::vector<DetectMark> &marks,
                   std::vector<std::string> &extensions) {
  ProgramMarks detection;
  readInto(in, detect, detectionRecord, detection);
  marks = std::move(detection.marks);
  extensions = std::move(detection.extensions);
}

} // namespace ncvet
