// The format of a code: its words, and the formulas over them.
#include "formats/dialect/dialect_builder.h"
#include "formats/dialect/field.h"
#include "formats/dialect/measure.h"
#include "formats/dialect/variable_key.h"

#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

namespace ncvet {

void readValue(JsonReader &in, const Shape &, const Json &value, Formula &target) {
  target = static_cast<DialectBuilder &>(in).formula(value);
}

void checkBounds(JsonReader &in, const Json &value, const ValueTest &test) {
  if (test.min > test.max)
    in.fail(value, "\"min\" is greater than \"max\"");
}

void DialectBuilder::readWords(const Json &words, CodeInfo &info) {
  if (!isObject(words))
    return;
  // Arguments in their order: by their names "10 CPO" comes before "9 CPA".
  std::vector<Json::const_iterator> entries;
  for (auto entry = words.begin(); entry != words.end(); ++entry)
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
  // Their formulas may name words after their own.
  for (size_t index = 0; index < entries.size(); ++index)
    if (const Json *when = member(*entries[index], "when"))
      readInto(*this, *when, conditionRecord, info.words[index].when);
}

WordSpec DialectBuilder::readWord(const std::string &name, const Json &value) {
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
      fail(value, "arguments are counted from 1");
  } else {
    spelling.split(names, '|');
  }
  for (llvm::StringRef one : names)
    if (std::optional<AddressId> address = addressId(value, one))
      word.any |= maskOf(*address);
  readInto(*this, value, wordRecord, word);
  return word;
}

void DialectBuilder::readExcludes(const Json &value, CodeInfo &info) {
  if (!value.is_array())
    return fail(value, "a list of pairs of address sets is expected");
  for (const Json &pair : value) {
    if (!pair.is_array() || pair.size() != 2)
      return fail(pair, "a pair of address sets is expected");
    info.excludes.emplace_back(addressSet(pair[0]), addressSet(pair[1]));
    info.takes |= info.excludes.back().first | info.excludes.back().second;
  }
}

/// A word of the code being read, or an address of the control.
std::optional<FormulaName> DialectBuilder::formulaName(llvm::StringRef name) const {
  for (size_t i = 0; i < code_->words.size(); ++i)
    if (code_->words[i].name == name)
      return FormulaName{FormulaOp::Word, uint16_t(i)};
  for (unsigned address = 0; address < addressCount; ++address)
    if (dialect_.addresses[address].kind != AddressKind::Unknown &&
        dialect_.addressName(AddressId(address)) == name)
      return FormulaName{FormulaOp::Address, uint16_t(address)};
  return std::nullopt;
}

Formula DialectBuilder::formula(const Json &value) {
  const std::optional<std::string> given = text(value);
  if (!given)
    return {};
  std::string error;
  if (const auto formula = parseFormula(
          *given, [&](llvm::StringRef name) { return formulaName(name); }, error))
    return *formula;
  fail(value, "the formula " + error);
  return {};
}

/// `{"LOW": "X", "HIGH": {"value": "Y", "when": "Y > 0"}, "SEEN": "1", "ANY": true, "OLD": false}`,
/// `{"_RADIUS": {"index": "P", "value": "R"}}`
void DialectBuilder::readStores(const Json &stores, CodeInfo &info) {
  if (!isObject(stores))
    return;
  for (auto entry = stores.begin(); entry != stores.end(); ++entry) {
    Store &store = info.stores.emplace_back();
    store.variable = variableKey(entry.key());
    // `V1025`: a variable with a number.
    const llvm::StringRef name = entry.key();
    if (int64_t index = 0; name.size() > 1 && !name.drop_front().getAsInteger(10, index))
      store.variable = elementKey(variableKey(name.take_front()), index);
    if (entry->is_boolean())
      store.forgets = !entry->get<bool>();
    else if (!entry->is_object())
      store.value = formula(*entry);
    else
      readInto(*this, *entry, storeRecord, store);
    if (!store.index.empty())
      store.list = entry.key();
  }
}

/// `{"_metric": 1, "5220": 2}`
void DialectBuilder::readShows(const Json &shows, CodeInfo &info) {
  if (!isObject(shows))
    return;
  for (auto entry = shows.begin(); entry != shows.end(); ++entry) {
    if (!entry->is_number())
      return fail(*entry, "a number is expected");
    info.shows.emplace_back(controlVariableKey(entry.key()), entry->get<double>());
  }
}

/// `{"run-out": "floor(P / 100)"}`
void DialectBuilder::readMeasures(const Json &measures, CodeInfo &info) {
  if (!isObject(measures))
    return;
  for (auto entry = measures.begin(); entry != measures.end(); ++entry) {
    const auto *name = llvm::find(measureNames(), llvm::StringRef(entry.key()));
    if (name == measureNames().end())
      return fail(*entry, "no measure has this name");
    info.measures.push_back({Measure(name - measureNames().begin()), formula(*entry)});
  }
}

void DialectBuilder::readTraits(const Json &traits, CodeInfo &info) {
  for (const std::string &trait : texts(traits)) {
    const auto *name = llvm::find(cycleTraitNames(), llvm::StringRef(trait));
    if (name == cycleTraitNames().end())
      return fail(traits, "no trait of a cycle has the name \"" + trait + "\"");
    info.traits |= 1u << (name - cycleTraitNames().begin());
  }
}

} // namespace ncvet
