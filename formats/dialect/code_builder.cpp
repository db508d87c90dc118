// Codes of a dialect out of its merged JSON: names, groups, words, notices, variants.
#include "formats/dialect/code_name.h"
#include "formats/dialect/dialect_builder.h"
#include "formats/dialect/measure.h"
#include "formats/dialect/variable_key.h"
#include "formats/dialect/vocabulary.h"

#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

llvm::ArrayRef<llvm::StringRef> codeKeys() {
  static constexpr llvm::StringLiteral keys[] = {"title",        "group",
                                                 "does",         "cycle",
                                                 "cancelsCycle", "takes",
                                                 "needs",        "fires",
                                                 "opposite",     "spindle",
                                                 "words",        "excludes",
                                                 "notices",      "variants",
                                                 "switch",       "alone",
                                                 "exclusive",    "twoBlock",
                                                 "source",       "waits",
                                                 "ownMove",      "arguments",
                                                 "foreign",      "endsMotion",
                                                 "cancelsCalls", "family",
                                                 "stores",       "stopsSpindle",
                                                 "levels",       "frame",
                                                 "places",       "measures",
                                                 "traits",       "firesByMotionCode",
                                                 "storedAt",     "returns",
                                                 "steps",        "losesPlace"};
  static const std::vector<llvm::StringRef> list(std::begin(keys), std::end(keys));
  return list;
}

} // namespace

/// All codes get their place and group before any is read in full: conditions name other codes.
void DialectBuilder::nameCodes(const Json &codes) {
  std::vector<std::pair<uint64_t, std::string>> order; // letter and number, then names
  for (auto entry = codes.begin(); entry != codes.end(); ++entry) {
    std::optional<CodeName> name = parseCodeName(entry.key());
    if (name && toString(*name) != entry.key())
      return in_.fail(*entry, "is written \"" + toString(*name) + "\"");
    if (!name && dialect_.reader == "iso")
      return in_.fail(*entry, "the name of a G or M code is expected");
    order.emplace_back(name ? uint64_t(name->letter) << 32 | name->numberTimesTen : UINT64_MAX,
                       entry.key());
  }
  std::sort(order.begin(), order.end());
  dialect_.codes.reserve(order.size() + order.size() / 4);
  for (const auto &[rank, name] : order)
    nameCode(name, codes[name]);
}

void DialectBuilder::nameCode(const std::string &name, const Json &value) {
  if (!in_.isObject(value))
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
      return in_.fail(value, "an M code has no decimal");
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
  const Json *member = in_.member(value, "group");
  std::optional<std::string> id = member ? in_.text(*member) : std::nullopt;
  if (!id)
    return;
  std::vector<llvm::StringRef> known;
  for (size_t at = 0; at < dialect_.groups.size(); ++at) {
    GroupInfo &group = dialect_.groups[at];
    known.push_back(group.id);
    if (group.id != *id)
      continue;
    if (group.members.size() == maxGroupMembers)
      return in_.fail(*member,
                      "the group has more than " + llvm::Twine(maxGroupMembers) + " members");
    dialect_.codes[index].group = GroupIndex(at);
    dialect_.codes[index].bit = uint8_t(group.members.size());
    group.members.push_back(index);
    return;
  }
  in_.fail(*member, "unknown group \"" + *id + "\"" + suggest(*id, known));
}

void DialectBuilder::readCodes(const Json &codes) {
  size_t count = dialect_.codes.size();
  for (size_t index = 0; index < count && !in_.failed(); ++index) {
    const std::string name = dialect_.codes[index].name;
    const Json &value = codes[name];
    in_.allowKeys(value, codeKeys());
    dialect_.codes[index] = readCode(value, dialect_.codes[index]);
    if (in_.member(value, "variants"))
      readVariants(name, value, CodeIndex(index));
  }
}

CodeInfo DialectBuilder::readCode(const Json &value, CodeInfo info) {
  in_.read(value, "title", info.title);
  in_.read(value, "source", info.source);
  in_.read(value, "cancelsCycle", info.cancelsCycle);
  in_.read(value, "alone", info.alone);
  in_.read(value, "exclusive", info.exclusive);
  in_.read(value, "twoBlock", info.twoBlock);
  in_.read(value, "waits", info.waits);
  in_.read(value, "returns", info.returns);
  in_.read(value, "ownMove", info.ownMove);
  in_.read(value, "stopsSpindle", info.stopsSpindle);
  in_.read(value, "family", info.family);
  in_.read(value, "cancelsCalls", info.cancelsCalls);
  in_.read(value, "firesByMotionCode", info.firesByMotionCode);
  in_.read(value, "endsMotion", info.endsMotion);
  in_.read(value, "foreign", info.foreign);
  in_.readWhole(value, "arguments", info.arguments, 0, 100);
  in_.readWhole(value, "storedAt", info.storedAt, 0, 999999);
  in_.readName(value, "does", "action", actionNames(), info.action);
  in_.readName(value, "cycle", "cycle", cycleNames(), info.cycle);
  in_.readName(value, "frame", "frame", frameNames(), info.frame);
  in_.readName(value, "spindle", "spindle need", spindleNames(), info.spindle);
  readSet(value, "takes", info.takes);
  if (const Json *fires = in_.member(value, "fires")) {
    info.firesOnEveryBlock = fires->is_string() && fires->get_ref<const std::string &>() == "*";
    info.firesInPlane = fires->is_string() && fires->get_ref<const std::string &>() == "plane";
    if (!info.firesOnEveryBlock && !info.firesInPlane)
      info.fires = addressSet(*fires);
  }
  if (const Json *opposite = in_.member(value, "opposite"))
    if (std::vector<CodeIndex> list = codeList(*opposite); list.size() == 1)
      info.opposite = list.front();
  readNeeds(value, info);
  readSwitch(value, info);
  code_ = &info;
  readWords(value, info);
  readExcludes(value, info);
  readNotices(value, info);
  readStores(value, info);
  readLevels(value, info);
  readPlaces(value, info);
  readMeasures(value, info);
  readSteps(value, info);
  return info;
}

void DialectBuilder::readNeeds(const Json &value, CodeInfo &info) {
  const Json *needs = in_.member(value, "needs");
  if (!needs)
    return;
  for (const std::string &need : in_.texts(*needs)) {
    info.needsFeed |= need == "feed";
    info.needsSpeed |= need == "speed";
    if (need != "feed" && need != "speed")
      in_.fail(*needs, "unknown need \"" + need + "\"; one of feed, speed");
  }
}

void DialectBuilder::readSwitch(const Json &value, CodeInfo &info) {
  const Json *member = in_.member(value, "switch");
  if (!member) {
    if (value.is_object() && !value.contains("switch"))
      switchCoolant(info);
    return;
  }
  in_.allowKeys(*member, {"id", "to", "offByZero"});
  static constexpr llvm::StringLiteral states[] = {"off", "on"};
  std::string id;
  in_.read(*member, "id", id);
  in_.readName(*member, "to", "state", states, info.effect.on);
  in_.read(*member, "offByZero", info.effect.offByZero);
  std::vector<llvm::StringRef> known;
  for (size_t index = 0; index < dialect_.switches.size(); ++index) {
    known.push_back(dialect_.switches[index].id);
    if (dialect_.switches[index].id != id)
      continue;
    info.effect.index = uint8_t(index);
    return;
  }
  in_.fail(*member, "unknown switch \"" + id + "\"" + suggest(id, known));
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

void DialectBuilder::readWords(const Json &value, CodeInfo &info) {
  const Json *words = in_.member(value, "words");
  if (!words || !in_.isObject(*words))
    return;
  // Arguments in their order: by their names "10 CPO" comes in front of "9 CPA".
  std::vector<Json::const_iterator> entries;
  for (auto entry = words->begin(); entry != words->end(); ++entry)
    entries.push_back(entry);
  const auto position = [](const Json::const_iterator &entry) {
    unsigned number = 0;
    llvm::StringRef name = entry.key();
    name.consumeInteger(10, number);
    return number;
  };
  llvm::stable_sort(entries,
                    [&](const auto &x, const auto &y) { return position(x) < position(y); });
  for (const auto &entry : entries) {
    info.words.push_back(readWord(entry.key(), *entry));
    info.takes |= info.words.back().any;
  }
  // Formulas may name words behind their own.
  for (size_t index = 0; index < entries.size(); ++index)
    if (const Json *when = in_.member(*entries[index], "when"))
      readFormula(*when, info.words[index].when);
}

/// What the words of the code at hand must keep.
void DialectBuilder::readFormula(const Json &value, Condition &when) {
  if (const Json *member = in_.member(value, "formula"))
    when.formula = formula(*member);
}

/// A formula over the words of the code at hand.
Formula DialectBuilder::formula(const Json &value) {
  const std::optional<std::string> text = in_.text(value);
  if (!text)
    return {};
  std::string error;
  const auto known = [&](llvm::StringRef name) -> std::optional<FormulaName> {
    for (size_t i = 0; i < code_->words.size(); ++i)
      if (code_->words[i].name == name)
        return FormulaName{FormulaOp::Word, uint16_t(i)};
    for (unsigned address = 0; address < addressCount; ++address)
      if (dialect_.addresses[address].kind != AddressKind::Unknown &&
          dialect_.addressName(AddressId(address)) == name)
        return FormulaName{FormulaOp::Address, uint16_t(address)};
    return std::nullopt;
  };
  if (const auto formula = parseFormula(*text, known, error))
    return *formula;
  in_.fail(value, "the formula " + error);
  return {};
}

/// `{"LOW": "X", "HIGH": {"value": "Y", "when": "Y > 0"}, "SEEN": "1", "ANY": true, "OLD": false}`,
/// `{"_RADIUS": {"index": "P", "value": "R"}}`
void DialectBuilder::readStores(const Json &value, CodeInfo &info) {
  const Json *stores = in_.member(value, "stores");
  if (!stores || !in_.isObject(*stores))
    return;
  for (auto entry = stores->begin(); entry != stores->end(); ++entry) {
    Store store;
    store.variable = variableKey(entry.key());
    // `V1025`: a variable with a number.
    const llvm::StringRef name = entry.key();
    if (int64_t index = 0; name.size() > 1 && !name.drop_front().getAsInteger(10, index))
      store.variable = elementKey(variableKey(name.take_front()), index);
    if (entry->is_boolean())
      store.forgets = !entry->get<bool>();
    else if (!entry->is_object())
      store.value = formula(*entry);
    else {
      in_.allowKeys(*entry, {"value", "when", "index"});
      if (const Json *member = in_.member(*entry, "index")) {
        store.list = entry.key();
        store.index = formula(*member);
      }
      if (const Json *member = in_.member(*entry, "value"))
        store.value = formula(*member);
      if (const Json *member = in_.member(*entry, "when"))
        store.when = formula(*member);
    }
    info.stores.push_back(std::move(store));
  }
}

/// `{"approach": "RFP + SDIS", "bottom": "DP"}`
void DialectBuilder::readLevels(const Json &value, CodeInfo &info) {
  const Json *levels = in_.member(value, "levels");
  if (!levels || !in_.isObject(*levels))
    return;
  in_.allowKeys(*levels, {"approach", "bottom"});
  if (const Json *approach = in_.member(*levels, "approach"))
    info.approach = formula(*approach);
  if (const Json *bottom = in_.member(*levels, "bottom"))
    info.bottom = formula(*bottom);
}

/// `{"count": "NUM", "first": "CPA + RAD * cos(STA1 + index() * INDA)", "second": "…"}`
void DialectBuilder::readPlaces(const Json &value, CodeInfo &info) {
  const Json *places = in_.member(value, "places");
  if (!places || !in_.isObject(*places))
    return;
  in_.allowKeys(*places, {"count", "first", "second"});
  const Json *count = in_.member(*places, "count"), *first = in_.member(*places, "first"),
             *second = in_.member(*places, "second");
  if (!first || !second)
    return in_.fail(*places, "\"first\" and \"second\" are expected");
  if (count)
    info.count = formula(*count);
  info.places = {formula(*first), formula(*second)};
}

/// `{"when": "…", "of": [{"shift": ["X", "Y", "0"]}, {"turn": ["ANR"], "axis": "Z"},
/// {"scale": ["SCA", "SCA", "SCA"]}, {"matrix": [twelve numbers]}]}`
void DialectBuilder::readSteps(const Json &value, CodeInfo &info) {
  if (const Json *when = in_.member(value, "losesPlace"))
    info.losesPlace = formula(*when);
  info.frameSteps.clear();
  const Json *steps = in_.member(value, "steps");
  if (!steps || steps->is_null() || !in_.isObject(*steps))
    return;
  in_.allowKeys(*steps, {"when", "of"});
  info.frame = FrameKind::Steps;
  if (const Json *when = in_.member(*steps, "when"))
    info.frameWhen = formula(*when);
  const Json *list = in_.member(*steps, "of");
  if (!list || !list->is_array())
    return in_.fail(*steps, "\"of\" is a list of steps");
  for (const Json &entry : *list)
    if (!readStep(entry, info))
      return;
}

bool DialectBuilder::readStep(const Json &entry, CodeInfo &info) {
  using Kind = FrameStep::Kind;
  in_.allowKeys(entry, {"shift", "turn", "scale", "matrix", "axis"});
  FrameStep step;
  const Json *numbers = nullptr;
  constexpr std::pair<const char *, Kind> kinds[] = {{"shift", Kind::Shift},
                                                     {"turn", Kind::Turn},
                                                     {"scale", Kind::Scale},
                                                     {"matrix", Kind::Matrix}};
  for (const auto &[name, kind] : kinds)
    if (const Json *found = in_.member(entry, name)) {
      numbers = found;
      step.kind = kind;
    }
  if (!numbers || !numbers->is_array())
    in_.fail(entry, "a step is a shift, a turn, a scale or a matrix, with its numbers");
  if (in_.failed())
    return false;
  for (const Json &number : *numbers)
    step.numbers.push_back(formula(number));
  const size_t count = step.numbers.size();
  constexpr size_t threeLengths = 3, matrix = 12, withCentre = 4;
  if (step.kind == Kind::Turn     ? count != 1 && count != withCentre
      : step.kind == Kind::Matrix ? count != matrix
                                  : count != threeLengths)
    in_.fail(*numbers, "a shift and a scale have 3 numbers, a turn 1 or 4, a matrix 12");
  if (const Json *axis = in_.member(entry, "axis")) {
    const std::string name = in_.text(*axis).value_or("");
    if (name.size() != 1 || name[0] < 'X' || name[0] > 'Z')
      in_.fail(*axis, "X, Y or Z is expected");
    else
      step.axis = uint8_t(name[0] - 'X');
  }
  info.frameSteps.push_back(std::move(step));
  return !in_.failed();
}

/// `"measures": {"run-out": "floor(P / 100)"}, "traits": ["returns-by-axes"]`
void DialectBuilder::readMeasures(const Json &value, CodeInfo &info) {
  info.measures.clear();
  info.traits = 0;
  if (const Json *measures = in_.member(value, "measures"); measures && in_.isObject(*measures)) {
    for (auto entry = measures->begin(); entry != measures->end(); ++entry) {
      const auto names = measureNames();
      const auto *name = llvm::find(names, llvm::StringRef(entry.key()));
      if (name == names.end())
        in_.fail(*entry, "no measure has this name");
      else if (!entry->is_null())
        info.measures.push_back({Measure(name - names.begin()), formula(*entry)});
    }
  }
  if (const Json *traits = in_.member(value, "traits")) {
    for (const std::string &trait : in_.texts(*traits)) {
      const auto names = cycleTraitNames();
      const auto *name = llvm::find(names, llvm::StringRef(trait));
      if (name == names.end())
        in_.fail(*traits, "no trait of a cycle has the name \"" + trait + "\"");
      else
        info.traits |= 1u << (name - names.begin());
    }
  }
}

WordSpec DialectBuilder::readWord(const std::string &name, const Json &value) {
  in_.allowKeys(value, {"need", "role", "text", "absent", "severity", "when", "min", "max",
                        "minExclusive", "maxExclusive", "integer", "oneOf", "point",
                        "rangeSeverity", "pointAdvised", "note", "characters", "naming"});
  WordSpec word;
  llvm::SmallVector<llvm::StringRef, 4> names;
  llvm::StringRef spelling = name;
  if (spelling.consume_front("@")) { // a variable
    const auto [first, other] = spelling.split('|');
    word.name = first.str();
    word.variable = variableKey(first);
    word.orVariable = other.empty() ? 0 : variableKey(other);
  } else if (!spelling.consumeInteger(10, word.position)) { // "3 SDIS": the third argument
    word.name = spelling.trim().str();
    if (!word.position)
      in_.fail(value, "arguments are counted from 1");
  } else {
    spelling.split(names, '|');
  }
  for (llvm::StringRef one : names)
    if (std::optional<AddressId> address = addressId(value, one))
      word.any |= maskOf(*address);
  in_.readName(value, "need", "need", needNames(), word.need);
  in_.readName(value, "role", "role", roleNames(), word.role);
  in_.read(value, "severity", word.severity);
  in_.read(value, "rangeSeverity", word.rangeSeverity);
  in_.read(value, "note", word.note);
  in_.read(value, "text", word.text);
  in_.read(value, "characters", word.characters);
  in_.readName(value, "naming", "naming", namingNames(), word.naming);
  if (const Json *absent = in_.member(value, "absent"))
    word.absent = in_.number(*absent);
  if (in_.member(value, "pointAdvised")) {
    bool advised = false;
    in_.read(value, "pointAdvised", advised);
    word.pointAdvised = advised;
  }
  if (const Json *when = in_.member(value, "when"))
    word.when = readCondition(*when);
  for (const char *key : {"min", "max", "integer", "oneOf", "point"})
    word.hasRange |= in_.member(value, key) != nullptr;
  if (word.hasRange)
    word.range = readTest(value);
  return word;
}

ValueTest DialectBuilder::readTest(const Json &value) {
  ValueTest test;
  in_.read(value, "min", test.min);
  in_.read(value, "max", test.max);
  in_.read(value, "minExclusive", test.minExclusive);
  in_.read(value, "maxExclusive", test.maxExclusive);
  in_.read(value, "integer", test.integer);
  in_.readName(value, "point", "point rule", pointNames(), test.point);
  if (const Json *list = in_.member(value, "oneOf")) {
    if (!list->is_array())
      in_.fail(*list, "a list of numbers is expected");
    else
      for (const Json &element : *list)
        if (std::optional<double> number = in_.number(element))
          test.oneOf.push_back(*number);
  }
  if (test.min > test.max)
    in_.fail(value, "\"min\" is greater than \"max\"");
  return test;
}

void DialectBuilder::readExcludes(const Json &value, CodeInfo &info) {
  const Json *list = in_.member(value, "excludes");
  if (!list)
    return;
  if (!list->is_array())
    return in_.fail(*list, "a list of pairs of address sets is expected");
  for (const Json &pair : *list) {
    if (!pair.is_array() || pair.size() != 2)
      return in_.fail(pair, "a pair of address sets is expected");
    info.excludes.emplace_back(addressSet(pair[0]), addressSet(pair[1]));
    info.takes |= info.excludes.back().first | info.excludes.back().second;
  }
}

void DialectBuilder::readNotices(const Json &value, CodeInfo &info) {
  if (const Json *list = in_.member(value, "notices"))
    readNoticeList(*list, /*shared=*/false, info);
}

/// Notices, and names of lists that several codes share.
void DialectBuilder::readNoticeList(const Json &list, bool shared, CodeInfo &info) {
  if (!list.is_array())
    return in_.fail(list, "a list of notices is expected");
  for (const Json &element : list)
    if (element.is_string() && !shared)
      readSharedNotices(element, info);
    else
      readNotice(element, info);
}

void DialectBuilder::readSharedNotices(const Json &name, CodeInfo &info) {
  const Json *lists = in_.member(root_, "sharedNotices");
  if (lists && !in_.isObject(*lists))
    return;
  const auto &id = name.get_ref<const std::string &>();
  if (const Json *list = lists ? in_.member(*lists, id.c_str()) : nullptr)
    return readNoticeList(*list, /*shared=*/true, info);
  std::vector<llvm::StringRef> known;
  if (lists)
    for (auto entry = lists->begin(); entry != lists->end(); ++entry)
      known.push_back(entry.key());
  in_.fail(name, "unknown shared notices" + suggest(id, known));
}

void DialectBuilder::readNotice(const Json &element, CodeInfo &info) {
  in_.allowKeys(element, {"rule", "severity", "when", "message", "at", "advice"});
  Notice notice;
  in_.read(element, "rule", notice.rule);
  in_.read(element, "severity", notice.severity);
  in_.read(element, "message", notice.message);
  in_.read(element, "advice", notice.advice);
  if (notice.rule.empty() || notice.message.empty())
    return in_.fail(element, "a notice needs \"rule\" and \"message\"");
  if (const Json *when = in_.member(element, "when"))
    readFormula(*when, notice.when = readCondition(*when));
  if (const Json *at = in_.member(element, "at"))
    if (std::optional<std::string> name = in_.text(*at)) {
      llvm::StringRef spelling = *name;
      if (spelling.consume_front("@"))
        notice.atVariable = variableKey(spelling);
      else
        notice.at = addressId(*at, *name).value_or(noAddress);
    }
  info.notices.push_back(std::move(notice));
}

/// A variant is the code's own entry with the variant's keys laid over it.
void DialectBuilder::readVariants(const std::string &name, const Json &value, CodeIndex base) {
  const Json &list = value["variants"];
  if (!list.is_array())
    return in_.fail(list, "a list of variants is expected");
  for (size_t at = 0; at < list.size() && !in_.failed(); ++at) {
    const Json &variant = list[at];
    if (!in_.isObject(variant))
      return;
    const Json *when = in_.member(variant, "when");
    if (!when)
      return in_.fail(variant, "a variant needs \"when\"");
    Variant entry;
    entry.when = readCondition(*when);
    code_ = &dialect_.codes[base];
    readFormula(*when, entry.when);
    Json own = variant;
    own.erase("when");
    Json whole = value;
    whole.erase("variants");
    layOver(whole, std::move(own));
    JsonStep code, variants, index;
    code.key = name;
    variants.key = "variants";
    index.isIndex = true;
    index.index = at;
    JsonStep codes;
    codes.key = "codes";
    in_.setOverlay(&whole, {codes, code, variants, index});
    in_.allowKeys(whole, codeKeys());
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
    if (in_.member(variant, "group")) { // a group of its own, or with null none at all
      dialect_.codes[entry.code].group = noGroup;
      joinGroup(whole, entry.code);
    }
    dialect_.codes[entry.code] = readCode(whole, dialect_.codes[entry.code]);
    dialect_.codes[base].variants.push_back(std::move(entry));
    in_.setOverlay(nullptr);
  }
}

Condition DialectBuilder::readCondition(const Json &value) {
  Condition when;
  in_.allowKeys(value, {"has", "any", "lacks", "active", "with", "without", "first", "pending",
                        "options", "broken", "formula", "on", "off", "before", "behind",
                        "spindleTurns", "toolKind", "otherToolKind"});
  when.on = switchSet(value, "on");
  when.off = switchSet(value, "off");
  readSet(value, "before", when.before);
  readSet(value, "behind", when.behind);
  if (in_.member(value, "spindleTurns")) {
    bool turns = false;
    in_.read(value, "spindleTurns", turns);
    when.spindleTurns = turns;
  }
  if (const Json *kinds = in_.member(value, "toolKind"))
    when.toolKind = in_.texts(*kinds);
  if (const Json *kinds = in_.member(value, "otherToolKind"))
    when.otherToolKind = in_.texts(*kinds);
  readSet(value, "has", when.has);
  readSet(value, "any", when.any);
  readSet(value, "lacks", when.lacks);
  in_.read(value, "first", when.first);
  if (in_.member(value, "pending")) {
    when.pending = CycleKind::None;
    in_.readName(value, "pending", "cycle", cycleNames(), *when.pending);
  }
  readConditionCodes(value, when);
  readConditionOptions(value, when);
  const Json *broken = in_.member(value, "broken");
  if (broken && !broken->is_array())
    in_.fail(*broken, "a list of tests is expected");
  else if (broken)
    for (const Json &element : *broken) {
      in_.allowKeys(element, {"word", "min", "max", "minExclusive", "maxExclusive", "integer",
                              "oneOf", "point"});
      ValueTest test = readTest(element);
      std::string word;
      in_.read(element, "word", word);
      test.address = addressId(element, word).value_or(noAddress);
      when.broken.push_back(std::move(test));
    }
  return when;
}

uint32_t DialectBuilder::switchSet(const Json &value, const char *key) {
  uint32_t set = 0;
  const Json *names = in_.member(value, key);
  if (!names)
    return 0;
  for (const std::string &name : in_.texts(*names)) {
    bool known = false;
    for (size_t i = 0; i < dialect_.switches.size(); ++i)
      if (dialect_.switches[i].id == name) {
        set |= 1u << i;
        known = true;
      }
    if (!known)
      in_.fail(*names, "unknown switch \"" + name + "\"");
  }
  return set;
}

void DialectBuilder::readConditionOptions(const Json &value, Condition &when) {
  const Json *options = in_.member(value, "options");
  if (!options || !in_.isObject(*options))
    return;
  for (auto entry = options->begin(); entry != options->end(); ++entry) {
    if (!dialect_.options.count(entry.key())) {
      std::vector<llvm::StringRef> known;
      for (const auto &option : dialect_.options)
        known.push_back(option.getKey());
      llvm::sort(known);
      return in_.fail(*entry, "unknown option" + suggest(entry.key(), known));
    }
    std::vector<std::string> values;
    if (entry->is_array())
      for (const Json &element : *entry)
        values.push_back(optionText(element));
    else
      values.push_back(optionText(*entry));
    when.options.emplace_back(entry.key(), std::move(values));
  }
}

void DialectBuilder::readConditionCodes(const Json &value, Condition &when) {
  std::vector<CodeIndex> groupless;
  if (const Json *active = in_.member(value, "active")) {
    when.active = groupStates(codeList(*active), groupless);
    if (!groupless.empty())
      in_.fail(*active, dialect_.codes[groupless.front()].name + " has no modal group");
    else if (when.active.size() > 1)
      in_.fail(*active, "codes of one modal group are expected");
  }
  if (const Json *with = in_.member(value, "with")) {
    std::vector<CodeIndex> codes = codeList(*with);
    when.with = groupStates(codes, groupless);
    // "One of these codes" over several groups can only be said by the codes themselves.
    if (!groupless.empty() || when.with.size() > 1) {
      when.with.clear();
      when.withCode = codes;
    }
  }
  if (const Json *without = in_.member(value, "without"))
    when.without = groupStates(codeList(*without), when.withoutCode);
}

std::vector<CodeIndex> DialectBuilder::codeList(const Json &value) {
  std::vector<CodeIndex> list;
  for (const std::string &name : in_.texts(value)) {
    auto found = namedCodes_.find(name);
    if (found != namedCodes_.end()) {
      list.push_back(found->second);
      continue;
    }
    in_.fail(value, "the table has no code \"" + name + "\"");
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

void DialectBuilder::readInitialStates() {
  const Json *table = in_.member(root_, "groups");
  if (!table)
    return;
  for (GroupInfo &group : dialect_.groups) {
    const Json *initial = in_.member((*table)[group.id], "initial");
    if (!initial)
      continue;
    for (CodeIndex code : codeList(*initial)) {
      if (!llvm::is_contained(group.members, code))
        in_.fail(*initial, dialect_.codes[code].name + " is not a member of this group");
      group.initial = dialect_.codes[code].bit;
    }
  }
}

} // namespace ncvet
