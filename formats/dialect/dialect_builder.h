// Makes a `Dialect` out of the merged JSON of a table and all that it extends.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/dialect/json_reader.h"

#include "llvm/ADT/StringMap.h"

namespace ncvet {

/// Reads the sections of a table in the order in which they need one another. Errors are kept in
/// the reader; the dialect is whole only when it has none.
class DialectBuilder {
public:
  DialectBuilder(JsonReader &reader, const Json &root, Dialect &dialect)
      : in_(reader), root_(root), dialect_(dialect) {}

  void build();

private:
  // dialect_builder.cpp: everything but codes
  void readHead();
  void readLexical();
  void readLimits();
  void readAddresses();
  void readAddress(const std::string &name, const Json &value);
  void readGroups();
  void readSwitches();
  void readToolRadius();
  void readRules();
  std::optional<AddressId> addressId(const Json &at, llvm::StringRef name);
  AddressMask addressSet(const Json &value);
  AddressMask addressSet(const Json &at, llvm::StringRef text);
  void readSet(const Json &object, const char *key, AddressMask &target);

  // code_builder.cpp: codes, their words, notices and variants
  void nameCodes(const Json &codes);
  void nameCode(const std::string &name, const Json &value);
  void joinGroup(const Json &value, CodeIndex index);
  void readCodes(const Json &codes);
  CodeInfo readCode(const Json &value, CodeInfo info);
  void readNeeds(const Json &value, CodeInfo &info);
  void readSwitch(const Json &value, CodeInfo &info);
  void switchCoolant(CodeInfo &info) const;
  void readWords(const Json &value, CodeInfo &info);
  WordSpec readWord(const std::string &name, const Json &value);
  void readExcludes(const Json &value, CodeInfo &info);
  void readNotices(const Json &value, CodeInfo &info);
  void readNoticeList(const Json &list, bool shared, CodeInfo &info);
  void readSharedNotices(const Json &name, CodeInfo &info);
  void readNotice(const Json &element, CodeInfo &info);
  void readVariants(const std::string &name, const Json &value, CodeIndex base);
  Condition readCondition(const Json &value);
  void readFormula(const Json &value, Condition &when);
  Formula formula(const Json &value);
  void readStores(const Json &value, CodeInfo &info);
  void readLevels(const Json &value, CodeInfo &info);
  void readPlaces(const Json &value, CodeInfo &info);
  void readSteps(const Json &value, CodeInfo &info);
  bool readStep(const Json &entry, CodeInfo &info);
  void readMeasures(const Json &value, CodeInfo &info);
  uint32_t switchSet(const Json &value, const char *key);
  void readConditionOptions(const Json &value, Condition &when);
  void readConditionCodes(const Json &value, Condition &when);
  ValueTest readTest(const Json &value);
  std::vector<CodeIndex> codeList(const Json &value);
  std::vector<std::pair<GroupIndex, uint64_t>> groupStates(llvm::ArrayRef<CodeIndex> codes,
                                                           std::vector<CodeIndex> &groupless) const;
  void readInitialStates();

  JsonReader &in_;
  const Json &root_;
  Dialect &dialect_;
  llvm::StringMap<CodeIndex> namedCodes_;
  const CodeInfo *code_ = nullptr; ///< being read: its words are what formulas name
};

/// Text form of an option's value: "true", "SL-30", "2.5"; empty for null.
std::string optionText(const Json &value);

/// Marks and file name endings of `detect`, which is not inherited.
void readDetection(JsonReader &in, const Json &detect, std::vector<DetectMark> &marks,
                   std::vector<std::string> &extensions);

} // namespace ncvet
