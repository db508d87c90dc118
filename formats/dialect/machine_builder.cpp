// Reads machine profiles from JSON.
#include "formats/dialect/machine_builder.h"

#include "formats/dialect/dialect_builder.h"
#include "formats/dialect/loader.h"
#include "formats/dialect/records.h"
#include "formats/dialect/vocabulary.h"

#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

constexpr llvm::StringLiteral toolKinds[] = {"endmill", "ballmill", "bullnose",  "facemill",
                                             "drill",   "tap",      "reamer",    "boring",
                                             "turning", "grooving", "threading", "probe"};

std::optional<size_t> axisIndex(JsonReader &in, const Json &at, const std::string &name) {
  for (size_t index = 0; index < axisNames().size(); ++index)
    if (axisNames()[index] == name)
      return index;
  std::vector<llvm::StringRef> known(axisNames().begin(), axisNames().end());
  in.fail(at, "unknown axis" + suggest(name, known));
  return std::nullopt;
}

} // namespace

llvm::ArrayRef<llvm::StringLiteral> toolKindNames() { return toolKinds; }

void readToolKind(JsonReader &in, const Json &value, ToolData &tool) {
  if (const auto kind = in.choice(&value, "kind of tool", toolKinds))
    tool.kind = toolKinds[*kind].str();
}

void readAxes(JsonReader &in, const Json &axes, MachineProfile &profile) {
  if (!in.isObject(axes))
    return;
  for (auto entry = axes.begin(); entry != axes.end(); ++entry)
    if (const auto index = axisIndex(in, *entry, entry.key()))
      readInto(in, *entry, axisRecord, profile.axes[*index]);
}

void readTools(JsonReader &in, const Json &tools, MachineProfile &profile) {
  if (!in.isObject(tools))
    return;
  profile.hasTools = true;
  for (auto entry = tools.begin(); entry != tools.end(); ++entry) {
    int number = 0;
    if (llvm::StringRef(entry.key()).getAsInteger(10, number) || number < 0)
      return in.fail(*entry, "a tool number is expected as key");
    readInto(in, *entry, toolRecord, profile.tools[number]);
  }
}

void readOffsets(JsonReader &in, const Json &offsets, MachineProfile &profile) {
  if (!in.isObject(offsets))
    return;
  for (auto entry = offsets.begin(); entry != offsets.end(); ++entry) {
    if (!in.isObject(*entry))
      return;
    auto &origin = profile.offsets[entry.key()];
    for (auto value = entry->begin(); value != entry->end(); ++value)
      if (const auto index = axisIndex(in, *value, value.key()))
        origin[*index] = in.number(*value);
  }
}

void checkMachineCodes(JsonReader &in, const Json &codes, MachineProfile &) { in.isObject(codes); }

void readMachineOptions(JsonReader &in, const Json &options, MachineProfile &profile) {
  if (!in.isObject(options))
    return;
  for (auto entry = options.begin(); entry != options.end(); ++entry)
    profile.options[entry.key()] = optionText(*entry);
}

llvm::Expected<MachineProfile> parseMachineProfile(llvm::StringRef name, llvm::StringRef text) {
  llvm::Expected<Json> json = parseJson(name, text);
  if (!json)
    return json.takeError();
  JsonLayer layer{name.str(), text};
  JsonReader reader(layer, *json);
  MachineProfile profile;
  readInto(reader, *json, machineRecord, profile);
  if (llvm::Error error = reader.takeError())
    return error;
  return profile;
}

} // namespace ncvet
