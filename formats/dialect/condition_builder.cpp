// Conditions of a table, and the notices that hold under them.
#include "formats/dialect/dialect_builder.h"
#include "formats/dialect/variable_key.h"

#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

namespace ncvet {

void DialectBuilder::readTestWord(const Json &value, ValueTest &test) {
  if (const auto name = text(value))
    test.address = addressId(value, *name).value_or(noAddress);
}

void DialectBuilder::readActive(const Json &value, Condition &when) {
  std::vector<CodeIndex> groupless;
  when.active = groupStates(codeList(value), groupless);
  if (!groupless.empty())
    fail(value, dialect_.codes[groupless.front()].name + " has no modal group");
  else if (when.active.size() > 1)
    fail(value, "codes of one modal group are expected");
}

void DialectBuilder::readWith(const Json &value, Condition &when) {
  std::vector<CodeIndex> groupless;
  const std::vector<CodeIndex> codes = codeList(value);
  when.with = groupStates(codes, groupless);
  // "One of these codes" over several groups can only be said by the codes themselves.
  if (!groupless.empty() || when.with.size() > 1) {
    when.with.clear();
    when.withCode = codes;
  }
}

void DialectBuilder::readWithout(const Json &value, Condition &when) {
  when.without = groupStates(codeList(value), when.withoutCode);
}

void DialectBuilder::readWhenOn(const Json &value, Condition &when) { when.on = switchSet(value); }
void DialectBuilder::readWhenOff(const Json &value, Condition &when) {
  when.off = switchSet(value);
}

uint32_t DialectBuilder::switchSet(const Json &names) {
  uint32_t set = 0;
  for (const std::string &name : texts(names))
    if (const auto index = switchIndex(names, name))
      set |= 1u << *index;
  return set;
}

void DialectBuilder::readWhenOptions(const Json &value, Condition &when) {
  if (!isObject(value))
    return;
  for (auto entry = value.begin(); entry != value.end(); ++entry) {
    if (!dialect_.options.count(entry.key())) {
      std::vector<llvm::StringRef> known;
      for (const auto &option : dialect_.options)
        known.push_back(option.getKey());
      llvm::sort(known);
      return fail(*entry, "unknown option" + suggest(entry.key(), known));
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

void DialectBuilder::readNotices(const Json &value, CodeInfo &info) {
  readNoticeList(value, /*shared=*/false, info);
}

/// Notices, and names of lists that several codes share.
void DialectBuilder::readNoticeList(const Json &list, bool shared, CodeInfo &info) {
  if (!list.is_array())
    return fail(list, "a list of notices is expected");
  for (const Json &element : list)
    if (element.is_string() && !shared)
      readSharedNotices(element, info);
    else
      readInto(*this, element, noticeRecord, info.notices.emplace_back());
}

void DialectBuilder::readSharedNotices(const Json &name, CodeInfo &info) {
  const Json *lists = member(root_, "sharedNotices");
  if (lists && !isObject(*lists))
    return;
  const auto &id = name.get_ref<const std::string &>();
  if (const Json *list = lists ? member(*lists, id.c_str()) : nullptr)
    return readNoticeList(*list, /*shared=*/true, info);
  std::vector<llvm::StringRef> known;
  if (lists)
    for (auto entry = lists->begin(); entry != lists->end(); ++entry)
      known.push_back(entry.key());
  fail(name, "unknown shared notices" + suggest(id, known));
}

void DialectBuilder::readNoticePlace(const Json &value, Notice &notice) {
  const std::optional<std::string> name = text(value);
  if (!name)
    return;
  llvm::StringRef spelling = *name;
  if (spelling.consume_front("@"))
    notice.atVariable = variableKey(spelling);
  else
    notice.at = addressId(value, *name).value_or(noAddress);
}

} // namespace ncvet
