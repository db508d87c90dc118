// Addresses, groups, switches, limits and rule settings of a dialect out of its merged JSON.
#include "formats/dialect/dialect_builder.h"

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
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void DialectBuilder::build() {
  in_.allowKeys(root_, {"$schema",
                        "id",
                        "title",
                        "extends",
                        "abstract",
                        "reader",
                        "machine",
                        "source",
                        "toolChangeByT",
                        "profileRunsThrough",
                        "dwellInMilliseconds",
                        "cycleSurvivesMotion",
                        "toolChangeGivesLength",
                        "emptyBlocksRun",
                        "endReturns",
                        "dwellBesideMove",
                        "polarByDistance",
                        "drilling",
                        "loadsWhole",
                        "offsetsOfTool",
                        "toolRadius",
                        "variables",
                        "controls",
                        "mainExtensions",
                        "subprogramExtensions",
                        "hiddenPrograms",
                        "lexical",
                        "limits",
                        "options",
                        "addresses",
                        "groups",
                        "switches",
                        "sharedNotices",
                        "codes",
                        "rules",
                        "detect"});
  readHead();
  readLexical();
  readLimits();
  readSwitches(); // addresses and the tool's radius name them
  readToolRadius();
  readAddresses();
  readGroups();
  if (const Json *codes = in_.member(root_, "codes"); codes && in_.isObject(*codes)) {
    nameCodes(*codes);
    if (!in_.failed())
      readCodes(*codes);
  }
  for (const CodeInfo &code : dialect_.codes)
    for (const WordSpec &word : code.words)
      dialect_.pointAdvised |= word.pointAdvised.value_or(false) ? word.any : 0;
  for (CodeInfo &code : dialect_.codes) {
    dialect_.callsModally |= code.action == Action::MacroModal || code.cancelsCalls;
    code.isProgram = !code.letter && llvm::any_of(dialect_.hiddenPrograms, [&](const auto &begin) {
      return llvm::StringRef(code.name).startswith(begin);
    });
  }
  VariableRanges &ranges = dialect_.variableRanges;
  ranges.units = dialect_.group(StandardGroup::Units);
  if (ranges.units != noGroup)
    for (const CodeIndex member : dialect_.groups[ranges.units].members)
      if (dialect_.codes[member].action == Action::Inch)
        ranges.inch |= uint64_t(1) << dialect_.codes[member].bit;
  bool lengthByTool = false;
  in_.read(root_, "toolChangeGivesLength", lengthByTool);
  if (lengthByTool)
    for (const CodeInfo &code : dialect_.codes)
      if (code.action == Action::LengthOff)
        dialect_.lengthByTool = code.group;
  if (!in_.failed())
    readInitialStates();
  readRules();
}

void DialectBuilder::readHead() {
  in_.read(root_, "id", dialect_.id);
  in_.read(root_, "title", dialect_.title);
  in_.read(root_, "reader", dialect_.reader);
  in_.read(root_, "abstract", dialect_.abstract);
  in_.read(root_, "toolChangeByT", dialect_.toolChangeByT);
  in_.read(root_, "profileRunsThrough", dialect_.profileRunsThrough);
  in_.read(root_, "dwellInMilliseconds", dialect_.dwellInMilliseconds);
  in_.read(root_, "cycleSurvivesMotion", dialect_.cycleSurvivesMotion);
  in_.read(root_, "emptyBlocksRun", dialect_.emptyBlocksRun);
  in_.read(root_, "endReturns", dialect_.endReturns);
  in_.read(root_, "dwellBesideMove", dialect_.dwellBesideMove);
  in_.read(root_, "polarByDistance", dialect_.polarByDistance);
  if (const Json *drilling = in_.member(root_, "drilling")) {
    in_.allowKeys(*drilling, {"levelOfRow", "risesFirst", "feedsOutToLevel"});
    in_.read(*drilling, "levelOfRow", dialect_.drilling.levelOfRow);
    in_.read(*drilling, "risesFirst", dialect_.drilling.risesFirst);
    in_.read(*drilling, "feedsOutToLevel", dialect_.drilling.feedsOutToLevel);
  }
  in_.read(root_, "loadsWhole", dialect_.loadsWhole);
  in_.read(root_, "offsetsOfTool", dialect_.offsetsOfTool);
  if (const Json *list = in_.member(root_, "mainExtensions"))
    dialect_.mainExtensions = in_.texts(*list);
  if (const Json *list = in_.member(root_, "subprogramExtensions"))
    dialect_.subprogramExtensions = in_.texts(*list);
  if (const Json *list = in_.member(root_, "hiddenPrograms"))
    dialect_.hiddenPrograms = in_.texts(*list);
  if (const Json *variables = in_.member(root_, "variables")) {
    in_.allowKeys(*variables, {"names", "axes", "readOnly", "machineData", "readAhead", "lastLocal",
                               "lastCommon", "namedLocal", "localsBeginVacant", "zeros", "place"});
    const auto list = [&](const char *key, std::vector<std::string> &target) {
      if (const Json *names = in_.member(*variables, key))
        target = in_.texts(*names);
    };
    list("names", dialect_.variableNames);
    list("axes", dialect_.axisVariables);
    list("readOnly", dialect_.readOnly);
    list("machineData", dialect_.machineData);
    list("readAhead", dialect_.readAhead);
    in_.readWhole(*variables, "lastLocal", dialect_.variableRanges.lastLocal, 0, 999999);
    in_.readWhole(*variables, "lastCommon", dialect_.variableRanges.lastCommon, 0, 999999);
    in_.read(*variables, "namedLocal", dialect_.variableRanges.namedLocal);
    in_.readWhole(*variables, "place", dialect_.variableRanges.place, 0, 999999);
    in_.read(*variables, "localsBeginVacant", dialect_.localsBeginVacant);
    if (const Json *zeros = in_.member(*variables, "zeros")) {
      in_.allowKeys(*zeros, {"systems", "step", "preset", "presetOn", "length"});
      ZeroVariables &to = dialect_.zeros;
      for (const auto &[key, number] :
           {std::pair{"systems", &to.systems}, std::pair{"step", &to.step},
            std::pair{"preset", &to.preset}, std::pair{"presetOn", &to.presetOn},
            std::pair{"length", &to.length}})
        in_.readWhole(*zeros, key, *number, 0, 999999);
    }
  }
  in_.readName(root_, "machine", "machine", machineNames(), dialect_.machine);
  for (const char *key : {"id", "title", "reader", "machine"})
    if (!in_.member(root_, key))
      in_.fail(root_, llvm::Twine("the key \"") + key + "\" is missing");
  if (const Json *options = in_.member(root_, "options"); options && in_.isObject(*options))
    for (auto entry = options->begin(); entry != options->end(); ++entry)
      dialect_.options[entry.key()] = optionText(*entry);
  if (const Json *detect = in_.member(root_, "detect"))
    readDetection(in_, *detect, dialect_.detect, dialect_.extensions);
}

void readDetection(JsonReader &in, const Json &detect, std::vector<DetectMark> &marks,
                   std::vector<std::string> &extensions) {
  in.allowKeys(detect, {"extensions", "marks"});
  if (const Json *list = in.member(detect, "extensions"))
    extensions = in.texts(*list);
  const Json *list = in.member(detect, "marks");
  if (!list)
    return;
  if (!list->is_array())
    return in.fail(*list, "a list of marks is expected");
  for (const Json &element : *list) {
    in.allowKeys(element, {"pattern", "score", "reason"});
    DetectMark mark;
    in.read(element, "pattern", mark.pattern);
    in.readWhole(element, "score", mark.score, -100, 100);
    in.read(element, "reason", mark.reason);
    if (mark.pattern.empty() || mark.reason.empty())
      in.fail(element, "a mark needs \"pattern\" and \"reason\"");
    marks.push_back(std::move(mark));
  }
}

void DialectBuilder::readLexical() {
  const Json *lexical = in_.member(root_, "lexical");
  if (!lexical)
    return;
  in_.allowKeys(*lexical, {"incrementOperator", "commaAddresses", "semicolon", "percentHeader",
                           "macro", "skipLevels", "headerMarks", "endLabel", "commaSeparates",
                           "blocksSpanLines", "structures", "flowWords", "assignsBehind",
                           "freeNumbers", "arithmetic", "abortMark"});
  Lexical &target = dialect_.lexical;
  in_.read(*lexical, "incrementOperator", target.incrementOperator);
  readSet(*lexical, "commaAddresses", target.commaAddresses);
  in_.readName(*lexical, "semicolon", "meaning of a semicolon", semicolonNames(), target.semicolon);
  in_.read(*lexical, "percentHeader", target.percentHeader);
  in_.read(*lexical, "macro", target.macro);
  in_.read(*lexical, "headerMarks", target.headerMarks);
  in_.read(*lexical, "commaSeparates", target.commaSeparates);
  in_.read(*lexical, "structures", target.structures);
  in_.read(*lexical, "blocksSpanLines", target.blocksSpanLines);
  in_.read(*lexical, "flowWords", target.flowWords);
  in_.read(*lexical, "assignsBehind", target.assignsBehind);
  in_.read(*lexical, "abortMark", target.abortMark);
  in_.read(*lexical, "freeNumbers", target.freeNumbers);
  in_.readName(*lexical, "arithmetic", "arithmetic", arithmeticNames(), target.arithmetic);
  in_.read(*lexical, "endLabel", target.endLabel);
  in_.readWhole(*lexical, "skipLevels", target.skipLevels, 0, 9);
  if (target.commaAddresses & ~(maskOf(commaA) | maskOf(commaC) | maskOf(commaR)))
    in_.fail(*in_.member(*lexical, "commaAddresses"), "only \",A\", \",C\" and \",R\" are known");
}

void DialectBuilder::readLimits() {
  const Json *limits = in_.member(root_, "limits");
  if (!limits)
    return;
  in_.allowKeys(*limits,
                {"mCodesPerBlock", "callDepth", "programDigits", "reservedPrograms", "blockLength",
                 "structureDepth", "nameLength", "repeatDepth", "labelLength"});
  in_.readWhole(*limits, "repeatDepth", dialect_.limits.repeatDepth, 0, 100);
  in_.readWhole(*limits, "labelLength", dialect_.limits.labelLength, 0, 100);
  in_.readWhole(*limits, "blockLength", dialect_.limits.blockLength, 0, 10000);
  in_.readWhole(*limits, "structureDepth", dialect_.limits.structureDepth, 0, 100);
  in_.readWhole(*limits, "nameLength", dialect_.limits.nameLength, 0, 100);
  in_.readWhole(*limits, "mCodesPerBlock", dialect_.limits.mCodesPerBlock, 0, 100);
  in_.readWhole(*limits, "callDepth", dialect_.limits.callDepth, 0, 100);
  if (const Json *digits = in_.member(*limits, "programDigits")) {
    if (!digits->is_array() || digits->size() != 2)
      return in_.fail(*digits, "a list of the least and the greatest number is expected");
    if (auto least = in_.whole(&(*digits)[0], 1, 20))
      dialect_.limits.programDigitsMin = uint16_t(*least);
    if (auto most = in_.whole(&(*digits)[1], 0, 20))
      dialect_.limits.programDigitsMax = uint16_t(*most);
  }
  if (const Json *reserved = in_.member(*limits, "reservedPrograms")) {
    if (!reserved->is_array())
      return in_.fail(*reserved, "a list of program numbers is expected");
    for (const Json &number : *reserved)
      if (auto value = in_.whole(&number, 0, 99999999))
        dialect_.limits.reservedPrograms.push_back(int(*value));
  }
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
  in_.fail(at, llvm::Twine("unknown address \"") + name + "\"");
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
  for (const std::string &name : in_.texts(value))
    if (std::optional<AddressId> address = addressId(value, name))
      mask |= maskOf(*address);
  return mask;
}

void DialectBuilder::readSet(const Json &object, const char *key, AddressMask &target) {
  if (const Json *value = in_.member(object, key))
    target = addressSet(*value);
}

void DialectBuilder::readAddresses() {
  for (unsigned address = commaA; address <= commaR; ++address)
    if (dialect_.lexical.commaAddresses & maskOf(AddressId(address))) {
      AddressInfo &info = dialect_.addresses[address];
      info.kind = AddressKind::Parameter;
      info.unit = address == commaA ? AddressUnit::Angle : AddressUnit::Length;
    }
  if (const Json *table = in_.member(root_, "addresses"); table && in_.isObject(*table))
    for (auto entry = table->begin(); entry != table->end(); ++entry)
      readAddress(entry.key(), *entry);
  for (unsigned address = 0; address < addressCount; ++address) {
    AddressMask mask = maskOf(AddressId(address));
    AddressKind kind = dialect_.addresses[address].kind;
    dialect_.known |= kind == AddressKind::Unknown ? 0 : mask;
    dialect_.incrementWords |= kind == AddressKind::Increment ? mask : 0;
    dialect_.elementWords |= kind == AddressKind::Element ? mask : 0;
    dialect_.polarWords |= kind == AddressKind::Polar || kind == AddressKind::Element ? mask : 0;
    dialect_.axisWords |= kind == AddressKind::Axis || kind == AddressKind::Increment ? mask : 0;
    dialect_.whole |= dialect_.addresses[address].unit == AddressUnit::Whole ? mask : 0;
    dialect_.repeatable |= dialect_.addresses[address].repeatable ? mask : 0;
    dialect_.pointAdvised |= dialect_.addresses[address].pointAdvised ? mask : 0;
    dialect_.plain |= kind == AddressKind::Code || kind == AddressKind::Number ? mask : 0;
  }
  dialect_.known |= addresslessWords;
  dialect_.repeatable |= addresslessWords;
  dialect_.plain |= dialect_.axisWords | lettersMask("FS") | addresslessWords;
  dialect_.plain &= ~lettersMask("NOL");
}

void DialectBuilder::readAddress(const std::string &name, const Json &value) {
  in_.allowKeys(value, {"kind", "axis", "unit", "diameter", "repeatable", "pointAdvised", "arc",
                        "corner", "rounding", "linesOnly", "acrossCorner", "lineAngle", "does",
                        "switch", "min", "max", "title"});
  if (name.size() > 1 && name[0] != ',') {
    const bool symbol = name.size() == 2 && name[1] == 'n' && llvm::isPrint(name[0]);
    if (!symbol && !llvm::all_of(name, llvm::isAlnum))
      return in_.fail(value, "an address is one letter, a comma and a letter, letters and digits, "
                             "or a character and `n` for its number");
    if (firstNamed + dialect_.addressNames.size() >= variableAddress)
      return in_.fail(value, "too many addresses of several letters");
    dialect_.addressNames.push_back(name);
  }
  std::optional<AddressId> address = addressId(value, name);
  if (!address || in_.failed())
    return;
  AddressInfo &info = dialect_.addresses[*address];
  in_.readName(value, "kind", "kind of address", addressKindNames(), info.kind);
  in_.readName(value, "unit", "unit", addressUnitNames(), info.unit);
  in_.readName(value, "axis", "axis", axisNames(), info.axis);
  in_.read(value, "diameter", info.diameter);
  in_.read(value, "repeatable", info.repeatable);
  in_.read(value, "pointAdvised", info.pointAdvised);
  in_.read(value, "title", info.title);
  in_.read(value, "corner", info.corner);
  in_.read(value, "rounding", info.rounding);
  in_.read(value, "linesOnly", info.linesOnly);
  in_.read(value, "acrossCorner", info.acrossCorner);
  in_.read(value, "lineAngle", info.lineAngle);
  dialect_.lineAngleWords |= info.lineAngle ? maskOf(*address) : 0;
  in_.read(value, "min", info.least);
  in_.read(value, "max", info.most);
  std::string does;
  in_.read(value, "does", does);
  const AddressMask own = maskOf(*address);
  if (does == "speed-limit")
    dialect_.speedLimitWords |= own;
  else if (does == "spindle-orient")
    dialect_.orientWords |= own;
  else if (!does.empty())
    in_.fail(value, "\"does\" is \"speed-limit\" or \"spindle-orient\"");
  dialect_.cornerWords |= info.corner ? own : 0;
  if (std::string id; in_.member(value, "switch")) {
    in_.read(value, "switch", id);
    for (size_t i = 0; i < dialect_.switches.size(); ++i)
      if (dialect_.switches[i].id == id)
        info.switches = uint8_t(i);
    if (info.switches == 0xFF)
      in_.fail(value, "unknown switch \"" + id + "\"");
    dialect_.switchWords |= own;
  }
  std::string arc;
  in_.read(value, "arc", arc);
  if (arc == "radius")
    dialect_.arcRadius = *address;
  else if (arc == "angle")
    dialect_.arcAngle = *address;
  else if (arc == "through-x" || arc == "through-y" || arc == "through-z")
    dialect_.arcThrough[size_t(arc.back() - 'x')] = *address;
  else if (!arc.empty())
    in_.fail(value, "\"arc\" is \"radius\", \"angle\" or \"through-x\", \"-y\", \"-z\"");
  bool moves = info.kind == AddressKind::Axis || info.kind == AddressKind::Increment;
  if (info.kind == AddressKind::Unknown)
    in_.fail(value, "an address needs its \"kind\"");
  else if (moves != (info.axis != Axis::Count))
    in_.fail(value, moves ? "an axis word needs its \"axis\"" : "only axis words have an \"axis\"");
}

void DialectBuilder::readGroups() {
  dialect_.standard.fill(noGroup);
  const Json *table = in_.member(root_, "groups");
  if (!table || !in_.isObject(*table))
    return;
  if (table->size() > maxGroups)
    return in_.fail(*table, "more than " + llvm::Twine(maxGroups) + " groups");
  for (auto entry = table->begin(); entry != table->end(); ++entry) {
    in_.allowKeys(*entry, {"title", "initial", "exclusive", "oneShot", "forgetsFeed", "standsFor"});
    GroupInfo group;
    group.id = entry.key();
    group.title = group.id;
    in_.read(*entry, "title", group.title);
    in_.read(*entry, "exclusive", group.exclusive);
    in_.read(*entry, "oneShot", group.oneShot);
    in_.read(*entry, "forgetsFeed", group.forgetsFeed);
    if (const Json *others = in_.member(*entry, "standsFor"))
      for (const std::string &other : in_.texts(*others))
        for (size_t index = 0; index < standardGroupNames().size(); ++index)
          if (standardGroupNames()[index] == other)
            dialect_.standard[index] = GroupIndex(dialect_.groups.size());
    for (size_t index = 0; index < standardGroupNames().size(); ++index)
      if (standardGroupNames()[index] == group.id)
        dialect_.standard[index] = GroupIndex(dialect_.groups.size());
    dialect_.groups.push_back(std::move(group));
  }
}

void DialectBuilder::readSwitches() {
  const Json *table = in_.member(root_, "switches");
  if (!table || !in_.isObject(*table))
    return;
  for (auto entry = table->begin(); entry != table->end(); ++entry) {
    in_.allowKeys(*entry, {"title", "off", "leftOn", "severity", "atToolChange", "survivesReset"});
    SwitchInfo info;
    info.id = entry.key();
    info.title = info.id;
    in_.read(*entry, "title", info.title);
    in_.read(*entry, "off", info.off);
    in_.read(*entry, "leftOn", info.leftOn);
    in_.read(*entry, "severity", info.severity);
    in_.read(*entry, "atToolChange", info.atToolChange);
    in_.read(*entry, "survivesReset", info.survivesReset);
    dialect_.switches.push_back(std::move(info));
  }
  if (dialect_.switches.size() > maxSwitches)
    in_.fail(*table, "more than " + llvm::Twine(maxSwitches) + " switches");
}

void DialectBuilder::readToolRadius() {
  const Json *source = in_.member(root_, "toolRadius");
  if (!source)
    return;
  in_.allowKeys(*source, {"variable", "unknownWhile"});
  in_.read(*source, "variable", dialect_.toolRadius.variable);
  std::string name;
  in_.read(*source, "unknownWhile", name);
  for (size_t i = 0; i < dialect_.switches.size() && !name.empty(); ++i)
    if (dialect_.switches[i].id == name) {
      dialect_.toolRadius.unknownWhile = uint8_t(i);
      return;
    }
  if (!name.empty())
    in_.fail(*source, "no switch has the id \"" + llvm::Twine(name) + "\"");
}

void DialectBuilder::readRules() {
  const Json *table = in_.member(root_, "rules");
  if (!table || !in_.isObject(*table))
    return;
  for (auto entry = table->begin(); entry != table->end(); ++entry) {
    if (!in_.isObject(*entry))
      return;
    RuleOverride &rule = dialect_.rules[entry.key()];
    in_.read(*entry, "severity", rule.severity);
    for (auto option = entry->begin(); option != entry->end(); ++option) {
      if (option.key() == "enabled") {
        bool enabled = true;
        in_.read(*entry, "enabled", enabled);
        rule.enabled = enabled;
      } else if (option.key() != "severity") {
        if (std::optional<double> value = in_.number(*option))
          rule.numbers[option.key()] = *value;
      }
    }
  }
}

} // namespace ncvet
