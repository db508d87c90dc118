// Reads machine profiles and answers what they say of options.
#include "formats/dialect/machine.h"

#include "formats/dialect/dialect_builder.h"
#include "formats/dialect/loader.h"
#include "formats/dialect/vocabulary.h"

#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

constexpr llvm::StringLiteral toolKinds[] = {"endmill", "ballmill", "bullnose",  "facemill",
                                             "drill",   "tap",      "reamer",    "boring",
                                             "turning", "grooving", "threading", "probe"};

class ProfileBuilder {
public:
  ProfileBuilder(JsonReader &reader, const Json &root, MachineProfile &profile)
      : in_(reader), root_(root), profile_(profile) {}

  void build() {
    in_.allowKeys(root_, {"$schema", "dialect", "axes", "spindle", "feed", "tools", "offsets",
                          "stock", "clamps", "codes", "options"});
    in_.read(root_, "dialect", profile_.dialect);
    readAxes();
    readSpindleAndFeed();
    readTools();
    readOffsets();
    readStock();
    readClamps();
    if (const Json *codes = in_.member(root_, "codes"))
      in_.isObject(*codes); // read by `overlay`, which knows the dialect
    if (const Json *options = in_.member(root_, "options"); options && in_.isObject(*options))
      for (auto entry = options->begin(); entry != options->end(); ++entry)
        profile_.options[entry.key()] = optionText(*entry);
  }

private:
  std::optional<size_t> axis(const Json &at, const std::string &name) {
    for (size_t index = 0; index < axisNames().size(); ++index)
      if (axisNames()[index] == name)
        return index;
    std::vector<llvm::StringRef> known(axisNames().begin(), axisNames().end());
    in_.fail(at, "unknown axis" + suggest(name, known));
    return std::nullopt;
  }

  void readAxes() {
    const Json *axes = in_.member(root_, "axes");
    if (!axes || !in_.isObject(*axes))
      return;
    for (auto entry = axes->begin(); entry != axes->end(); ++entry) {
      in_.allowKeys(*entry, {"min", "max"});
      if (std::optional<size_t> index = axis(*entry, entry.key())) {
        AxisLimits &limits = profile_.axes[*index];
        in_.read(*entry, "min", limits.min);
        in_.read(*entry, "max", limits.max);
        if (limits.min && limits.max && *limits.min > *limits.max)
          in_.fail(*entry, "\"min\" is greater than \"max\"");
      }
    }
  }

  /// A length, speed or feed that cannot be below zero.
  void readAmount(const Json &object, const char *key, std::optional<double> &target) {
    in_.read(object, key, target);
    if (target && *target < 0)
      in_.fail(*in_.member(object, key), "a number not below 0 is expected");
  }

  void readSpindleAndFeed() {
    if (const Json *spindle = in_.member(root_, "spindle")) {
      in_.allowKeys(*spindle, {"minSpeed", "maxSpeed"});
      readAmount(*spindle, "minSpeed", profile_.spindleMin);
      readAmount(*spindle, "maxSpeed", profile_.spindleMax);
    }
    if (const Json *feed = in_.member(root_, "feed")) {
      in_.allowKeys(*feed, {"max", "rapid"});
      readAmount(*feed, "max", profile_.feedMax);
      readAmount(*feed, "rapid", profile_.rapid);
    }
  }

  void readTools() {
    const Json *tools = in_.member(root_, "tools");
    if (!tools || !in_.isObject(*tools))
      return;
    profile_.hasTools = true;
    for (auto entry = tools->begin(); entry != tools->end(); ++entry) {
      in_.allowKeys(*entry, {"kind", "radius", "length", "pitch", "width", "tip"});
      int number = 0;
      if (llvm::StringRef(entry.key()).getAsInteger(10, number) || number < 0)
        return in_.fail(*entry, "a tool number is expected as key");
      ToolData tool;
      if (auto kind = in_.choice(in_.member(*entry, "kind"), "kind of tool", toolKinds))
        tool.kind = toolKinds[*kind].str();
      in_.read(*entry, "radius", tool.radius); // a worn tool may be entered below zero
      readAmount(*entry, "length", tool.length);
      readAmount(*entry, "pitch", tool.pitch);
      readAmount(*entry, "width", tool.width);
      if (auto tip = in_.whole(in_.member(*entry, "tip"), 0, 9))
        tool.tip = int(*tip);
      profile_.tools[number] = std::move(tool);
    }
  }

  void readOffsets() {
    const Json *offsets = in_.member(root_, "offsets");
    if (!offsets || !in_.isObject(*offsets))
      return;
    for (auto entry = offsets->begin(); entry != offsets->end(); ++entry) {
      if (!in_.isObject(*entry))
        return;
      auto &origin = profile_.offsets[entry.key()];
      for (auto value = entry->begin(); value != entry->end(); ++value)
        if (std::optional<size_t> index = axis(*value, value.key()))
          origin[*index] = in_.number(*value);
    }
  }

  void readStock() {
    const Json *stock = in_.member(root_, "stock");
    if (stock)
      profile_.stock = readBox(*stock);
  }

  void readClamps() {
    const Json *clamps = in_.member(root_, "clamps");
    if (!clamps)
      return;
    if (!clamps->is_array())
      return in_.fail(*clamps, "a list of boxes is expected");
    for (const Json &clamp : *clamps)
      profile_.clamps.push_back(readBox(clamp));
  }

  Stock readBox(const Json &value) {
    Stock box;
    in_.allowKeys(value, {"min", "max"});
    readCorner(value, "min", box.min);
    readCorner(value, "max", box.max);
    for (size_t i = 0; i < box.min.size(); ++i)
      if (box.min[i] && box.max[i] && *box.min[i] > *box.max[i])
        in_.fail(value, "\"min\" is greater than \"max\"");
    return box;
  }

  void readCorner(const Json &stock, const char *key,
                  std::array<std::optional<double>, 3> &corner) {
    const Json *value = in_.member(stock, key);
    if (!value)
      return;
    in_.allowKeys(*value, {"X", "Y", "Z"});
    in_.read(*value, "X", corner[0]);
    in_.read(*value, "Y", corner[1]);
    in_.read(*value, "Z", corner[2]);
  }

  JsonReader &in_;
  const Json &root_;
  MachineProfile &profile_;
};

} // namespace

std::optional<llvm::StringRef> MachineProfile::option(llvm::StringRef name) const {
  auto found = options.find(name);
  if (found == options.end() || found->second.empty())
    return std::nullopt;
  return llvm::StringRef(found->second);
}

std::optional<double> MachineProfile::number(llvm::StringRef name) const {
  double value = 0;
  std::optional<llvm::StringRef> text = option(name);
  if (!text || text->getAsDouble(value))
    return std::nullopt;
  return value;
}

llvm::Expected<MachineProfile> parseMachineProfile(llvm::StringRef name, llvm::StringRef text) {
  llvm::Expected<Json> json = parseJson(name, text);
  if (!json)
    return json.takeError();
  JsonLayer layer{name.str(), text};
  JsonReader reader(layer, *json);
  MachineProfile profile;
  ProfileBuilder(reader, *json, profile).build();
  if (llvm::Error error = reader.takeError())
    return error;
  return profile;
}

} // namespace ncvet
