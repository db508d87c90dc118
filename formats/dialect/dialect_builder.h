// Makes a `Dialect` out of the merged JSON of a table and all that it extends.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/dialect/json_reader.h"
#include "formats/dialect/records.h"

#include "llvm/ADT/StringMap.h"

namespace ncvet {

/// Reads a table by its records, whose fields are in the order in which they need one another.
/// Errors are kept as in any reader; the dialect is whole only when it has none. The functions that
/// take a value and a struct are what records name for keys that take more than their form.
class DialectBuilder : public JsonReader {
public:
  DialectBuilder(llvm::ArrayRef<JsonLayer> layers, const Json &root, Dialect &dialect)
      : JsonReader(layers, root), root_(root), dialect_(dialect) {}

  void build();

  // dialect_builder.cpp: everything but addresses and codes
  void readOptions(const Json &value, Dialect &dialect);
  void readShown(const Json &value, Dialect &dialect);
  void readLexical(const Json &value, Dialect &dialect);
  void readProgramDigits(const Json &value, Limits &limits);
  void readSwitches(const Json &value, Dialect &dialect);
  void readGroups(const Json &value, Dialect &dialect);
  void readActsAs(const Json &value, GroupInfo &group);
  void readFacts(const Json &value, Dialect &dialect);
  void readRules(const Json &value, Dialect &dialect);
  void readDetect(const Json &value, Dialect &dialect);

  // address_builder.cpp: addresses and sets of them
  void readAddresses(const Json &value, Dialect &dialect);
  void readAddressArc(const Json &value, AddressInfo &info);
  void readAddressAction(const Json &value, AddressInfo &info);
  void readAddressSwitch(const Json &value, AddressInfo &info);
  std::optional<AddressId> addressId(const Json &at, llvm::StringRef name);
  AddressMask addressSet(const Json &value);

  // code_builder.cpp: codes and their variants
  void readCodes(const Json &value, Dialect &dialect);
  void readNeeds(const Json &value, CodeInfo &info);
  void readFires(const Json &value, CodeInfo &info);
  void readOpposite(const Json &value, CodeInfo &info);
  void readSwitch(const Json &value, CodeInfo &info);
  void readSwitchId(const Json &value, SwitchEffect &effect);

  // code_format_builder.cpp: words and formulas of a code
  void readWords(const Json &value, CodeInfo &info);
  void readExcludes(const Json &value, CodeInfo &info);
  void readStores(const Json &value, CodeInfo &info);
  void readShows(const Json &value, CodeInfo &info);
  void readMeasures(const Json &value, CodeInfo &info);
  void readTraits(const Json &value, CodeInfo &info);
  Formula formula(const Json &value);

  // condition_builder.cpp: conditions and notices
  void readTestWord(const Json &value, ValueTest &test);
  void readActive(const Json &value, Condition &when);
  void readWith(const Json &value, Condition &when);
  void readWithout(const Json &value, Condition &when);
  void readWhenOptions(const Json &value, Condition &when);
  void readWhenOn(const Json &value, Condition &when);
  void readWhenOff(const Json &value, Condition &when);
  void readNotices(const Json &value, CodeInfo &info);
  void readNoticePlace(const Json &value, Notice &notice);

private:
  void summarizeAddresses();
  void summarizeCodes();
  void summarizeToolRadius();
  void showVariables();
  void readInitialStates();
  std::optional<size_t> switchIndex(const Json &at, llvm::StringRef id);

  void readAddress(const std::string &name, const Json &value);
  AddressMask addressSet(const Json &at, llvm::StringRef text);

  void nameCodes(const Json &codes);
  void nameCode(const std::string &name, const Json &value);
  void joinGroup(const Json &value, CodeIndex index);
  CodeInfo readCode(const Json &value, CodeInfo info);
  void switchCoolant(CodeInfo &info) const;
  void readVariants(const std::string &name, const Json &value, CodeIndex base);
  void readVariant(const JsonPath &place, const Json &value, const Json &variant, CodeIndex base);

  WordSpec readWord(const std::string &name, const Json &value);
  std::optional<FormulaName> formulaName(llvm::StringRef name) const;

  void readNoticeList(const Json &list, bool shared, CodeInfo &info);
  void readSharedNotices(const Json &name, CodeInfo &info);
  uint32_t switchSet(const Json &names);
  std::vector<CodeIndex> codeList(const Json &value);
  std::vector<std::pair<GroupIndex, uint64_t>> groupStates(llvm::ArrayRef<CodeIndex> codes,
                                                           std::vector<CodeIndex> &groupless) const;

  const Json &root_;
  Dialect &dialect_;
  llvm::StringMap<CodeIndex> namedCodes_;
  AddressId address_ = noAddress;  ///< being read
  const CodeInfo *code_ = nullptr; ///< being read: its words are what formulas name
};

/// Text form of an option's value: "true", "SL-30", "2.5"; empty for null.
std::string optionText(const Json &value);

/// Value of an option of a rule; none, with an error, when it is of no type that options have.
std::optional<OptionValue> readOptionValue(JsonReader &in, const Json &value);

/// An error when the least value of a test is greater than the greatest one.
void checkBounds(JsonReader &in, const Json &value, const ValueTest &test);

/// Marks and file name endings of `detect`, which is not inherited.
void readDetection(JsonReader &in, const Json &detect, std::vector<DetectMark> &marks,
                   std::vector<std::string> &extensions);

} // namespace ncvet
