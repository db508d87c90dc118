// Configuration: reading `.ncvet.json` and profiles, with errors that name the line.
#include "analyzer/setup/config.h"

#include "formats/dialect/config_file.h"
#include "formats/dialect/json_reader.h"
#include "formats/dialect/ruleset_files.h"
#include "formats/text/failure.h"
#include "formats/text/file_uri.h"
#include "formats/text/json_text.h"
#include "formats/text/read_file.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/GlobPattern.h"
#include "llvm/Support/Path.h"
#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

namespace path = llvm::sys::path;

constexpr unsigned maxExtends = 8; ///< longer chains are loops or mistakes

/// Text of the failure, so that it can be given a place in a file.
std::string messageOf(llvm::Error wrong) { return llvm::toString(std::move(wrong)); }

/// Calls `check` with each text of the list under `key`; what it says is wrong there.
void checkEach(JsonReader &in, const Json &object, const char *key,
               const std::vector<std::string> &texts,
               llvm::function_ref<llvm::Error(llvm::StringRef)> check) {
  const Json &list = *in.member(object, key);
  for (size_t i = 0; i < texts.size(); ++i)
    if (llvm::Error wrong = check(texts[i]))
      in.fail(list.is_array() ? list[i] : list, messageOf(std::move(wrong)));
}

void takeRuleNames(JsonReader &in, const Json &object, const char *key,
                   std::optional<std::vector<std::string>> &&given,
                   std::vector<std::string> &target) {
  if (!given)
    return;
  checkEach(in, object, key, *given,
            [](llvm::StringRef name) { return rulesNamed(name).takeError(); });
  target = std::move(*given);
}

/// The keys that profiles and configurations share.
void takeRuleSettings(JsonReader &in, const Json &object, RuleChoices &&given,
                      RuleSettings &rules) {
  takeRuleNames(in, object, "select", std::move(given.select), rules.select);
  takeRuleNames(in, object, "extendSelect", std::move(given.extendSelect), rules.extendSelect);
  takeRuleNames(in, object, "ignore", std::move(given.ignore), rules.ignore);
  if (const Json *severity = in.member(object, "severity"); severity && in.isObject(*severity))
    for (auto entry = severity->begin(); entry != severity->end(); ++entry) {
      if (auto named = rulesNamed(entry.key()); !named)
        in.fail(*entry, messageOf(named.takeError()));
      const std::optional<Severity> level =
          entry->is_string() ? parseSeverity(entry->get_ref<const std::string &>()) : std::nullopt;
      if (level)
        rules.severity.emplace_back(entry.key(), *level);
      else
        in.fail(*entry, "\"error\", \"warning\" or \"style\" is expected");
    }
  if (const Json *options = in.member(object, "options"); options && in.isObject(*options))
    for (auto rule = options->begin(); rule != options->end(); ++rule)
      if (in.isObject(*rule))
        for (auto entry = rule->begin(); entry != rule->end(); ++entry) {
          if (auto value = readRuleOption(rule.key(), entry.key(), *entry))
            rules.options.push_back({rule.key(), entry.key(), std::move(*value)});
          else
            in.fail(*entry, messageOf(value.takeError()));
        }
}

/// `name` relative to `folder`, unless it is absolute.
std::string joined(llvm::StringRef folder, llvm::StringRef name) {
  llvm::SmallString<256> result;
  if (!path::is_absolute(name))
    result = folder;
  path::append(result, name);
  path::remove_dots(result);
  return path::convert_to_slash(result);
}

llvm::Expected<std::string> readText(llvm::StringRef file) {
  auto buffer = readFile(file);
  if (!buffer)
    return buffer.takeError();
  return (*buffer)->getBuffer().str();
}

std::string unknownProfile(const std::string &name) {
  const std::vector<std::string> names = profileNames();
  const std::vector<llvm::StringRef> known(names.begin(), names.end());
  return "unknown profile \"" + name + "\"" + suggest(name, known);
}

std::vector<std::string> joinedPaths(llvm::ArrayRef<std::string> names, llvm::StringRef folder) {
  std::vector<std::string> paths;
  for (const std::string &name : names)
    paths.push_back(joined(folder, name));
  return paths;
}

void takeGlobs(JsonReader &in, const Json &json, const char *key, std::vector<std::string> &&given,
               std::vector<std::string> &target) {
  checkEach(in, json, key, given, [](llvm::StringRef text) -> llvm::Error {
    auto glob = llvm::GlobPattern::create(text);
    return glob ? llvm::Error::success()
                : failure("a glob is expected: " + messageOf(glob.takeError()));
  });
  target = std::move(given);
}

/// An object of settings in a file: the whole configuration, or one of its overrides.
struct SettingsObject {
  const Json &json;
  const JsonLayer &layer;
  JsonPath at; ///< where it is in the file
};

std::optional<MachineSource> readMachineOf(JsonReader &in, const SettingsObject &object,
                                           std::vector<std::string> &readFrom) {
  const auto &[json, layer, at] = object;
  const Json *machine = in.member(json, "machine");
  if (!machine)
    return std::nullopt;
  if (machine->is_object()) {
    const llvm::StringRef whole = layer.text;
    const size_t begin = at.empty() ? 0 : findJsonPlace(whole, at).value_or(0);
    const llvm::StringRef inside =
        findJsonMember(whole.drop_front(begin), "machine").value_or(whole);
    // Empty lines before it keep the line numbers of messages right.
    const unsigned line = lineAt(whole, size_t(inside.data() - whole.data()));
    return MachineSource{layer.name, std::string(line - 1, '\n') + inside.str()};
  }
  if (machine->is_string()) {
    const std::string name =
        joined(path::parent_path(layer.name), machine->get_ref<const std::string &>());
    readFrom.push_back(name);
    if (auto profile = readText(name))
      return MachineSource{name, std::move(*profile)};
    else
      in.fail(*machine, messageOf(profile.takeError()));
  } else {
    in.fail(*machine, "a path or a machine profile { … } is expected");
  }
  return std::nullopt;
}

/// The keys that a configuration and its overrides share: `given`, as read, into `target`. What is
/// not there leaves the target as it is.
template <typename Given, typename Target>
void takeFileSettings(JsonReader &in, const SettingsObject &object, Given &&given, Target &target,
                      std::vector<std::string> &readFrom) {
  const auto &[json, layer, at] = object;
  const llvm::StringRef folder = path::parent_path(layer.name);
  takeRuleSettings(in, json, std::move(given.rules), target.rules);
  if (const auto &name = given.dialect) {
    target.dialect = llvm::StringRef(*name).endswith(".json") ? joined(folder, *name) : *name;
    JsonPath place = at;
    place.push_back({"dialect", 0, false});
    const unsigned line = lineAt(layer.text, findJsonPlace(layer.text, place).value_or(0));
    target.dialectPlace = layer.name + ":" + std::to_string(line) + ": " + toString(place);
  }
  if (given.searchFolders)
    target.searchFolders = joinedPaths(*given.searchFolders, folder);
  if (auto machine = readMachineOf(in, object, readFrom))
    target.machine = std::move(machine);
  if (given.failOn)
    target.failOn = llvm::cantFail(parseFailOn(failOnNames()[*given.failOn]));
}

class ConfigReader {
public:
  explicit ConfigReader(Config &config) : config_(config) {}

  llvm::Error read(llvm::StringRef file, unsigned depth);

private:
  llvm::Error readExtended(JsonReader &in, const Json &json, const ConfigFile &given,
                           llvm::StringRef folder, unsigned depth);
  void readOverrides(JsonReader &in, const Json &json, const JsonLayer &layer);

  Config &config_;
};

llvm::Error ConfigReader::readExtended(JsonReader &in, const Json &json, const ConfigFile &given,
                                       llvm::StringRef folder, unsigned depth) {
  const std::optional<std::string> &name = given.extends;
  if (!name)
    return llvm::Error::success();
  const Json *extends = in.member(json, "extends");
  if (!llvm::StringRef(*name).endswith(".json")) {
    if (llvm::is_contained(profileNames(), *name))
      config_.profile = *name;
    else
      in.fail(*extends, unknownProfile(*name));
    return llvm::Error::success();
  }
  if (depth == maxExtends) {
    in.fail(*extends, "configurations extend each other too deep");
    return llvm::Error::success();
  }
  const std::string base = joined(folder, *name);
  if (!llvm::sys::fs::exists(base)) {
    in.fail(*extends, "cannot read " + base + ": no such file");
    return llvm::Error::success();
  }
  return read(base, depth + 1);
}

void ConfigReader::readOverrides(JsonReader &in, const Json &json, const JsonLayer &layer) {
  const Json *overrides = in.member(json, "overrides");
  if (!overrides || !overrides->is_array())
    return;
  for (size_t i = 0; i < overrides->size(); ++i) {
    const Json &entry = (*overrides)[i];
    OverrideFile given;
    readInto(in, entry, overrideRecord, given);
    if (in.failed())
      return;
    ConfigOverride override;
    override.folder = path::parent_path(layer.name).str();
    override.place = layer.name + ": overrides[" + std::to_string(i) + "]";
    const JsonPath at{{"overrides", 0, false}, {"", i, true}};
    takeFileSettings(in, {entry, layer, at}, std::move(given), override, config_.readFrom);
    takeGlobs(in, entry, "files", std::move(given.files), override.files);
    for (auto key = entry.begin(); key != entry.end(); ++key)
      override.given[key.key()] = jsonText(*key);
    config_.overrides.push_back(std::move(override));
  }
}

llvm::Error ConfigReader::read(llvm::StringRef file, unsigned depth) {
  config_.readFrom.push_back(file.str());
  auto text = readText(file);
  if (!text)
    return text.takeError();
  auto json = parseJson(file, *text);
  if (!json)
    return json.takeError();
  if (llvm::Error wrong = refuseRepeatedKeys(file, *text))
    return wrong;
  const JsonLayer layer{file.str(), *text};
  JsonReader in(layer, *json);
  ConfigFile given;
  readInto(in, *json, configRecord, given);
  if (llvm::Error wrong = in.takeError())
    return wrong;
  const std::string folder = path::parent_path(file).str();
  if (llvm::Error wrong = readExtended(in, *json, given, folder, depth))
    return wrong;
  for (auto entry = json->begin(); entry != json->end(); ++entry) {
    config_.setBy[entry.key()] = file.str();
    config_.given[entry.key()] = jsonText(*entry);
  }
  if (given.dialects)
    config_.dialectFiles = joinedPaths(*given.dialects, folder);
  if (given.files)
    takeGlobs(in, *json, "files", std::move(*given.files), config_.files);
  if (given.exclude)
    takeGlobs(in, *json, "exclude", std::move(*given.exclude), config_.exclude);
  takeFileSettings(in, {*json, layer, {}}, std::move(given), config_, config_.readFrom);
  readOverrides(in, *json, layer);
  return in.takeError();
}

} // namespace

llvm::Expected<FailOn> parseFailOn(llvm::StringRef text) {
  if (text == "never")
    return FailOn();
  if (const std::optional<Severity> severity = parseSeverity(text))
    return FailOn(severity);
  return failure("\"" + text + "\" is no level; one of error, warning, style, never");
}

llvm::Expected<Config> loadConfig(llvm::StringRef file) {
  Config config;
  config.file = file.str();
  config.folder = path::parent_path(file).str();
  if (llvm::Error wrong = ConfigReader(config).read(file, 0))
    return wrong;
  return config;
}

Config overridden(const Config &config, llvm::ArrayRef<size_t> which) {
  Config result = config;
  for (const size_t index : which) {
    const ConfigOverride &over = config.overrides[index];
    result.furtherRules.push_back(over.rules);
    if (over.dialect) {
      result.dialect = *over.dialect;
      result.dialectPlace = over.dialectPlace;
    }
    if (over.machine)
      result.machine = over.machine;
    if (over.searchFolders)
      result.searchFolders = *over.searchFolders;
    if (over.failOn)
      result.failOn = over.failOn;
    for (const auto &[key, value] : over.given) {
      if (key == "files")
        continue;
      result.given[key] = value;
      result.setBy[key] = over.place;
    }
  }
  return result;
}

std::string findConfig(llvm::StringRef folder) {
  llvm::SmallString<256> at = folder;
  if (llvm::sys::fs::make_absolute(at))
    return {};
  path::remove_dots(at, /*remove_dot_dot=*/true);
  const llvm::SmallString<256> start = at;
  while (true) {
    llvm::SmallString<256> file = at;
    path::append(file, configFileName);
    if (llvm::sys::fs::exists(file)) {
      if (at != start)
        return slashed(file);
      // In the folder itself it is named as the user named the folder.
      file = folder;
      path::append(file, configFileName);
      return slashed(file);
    }
    const llvm::StringRef parent = path::parent_path(at);
    if (parent.empty() || parent.size() >= at.size())
      return {};
    at.resize(parent.size());
  }
}

llvm::Expected<std::vector<RuleSettings>> loadProfile(llvm::StringRef name) {
  std::vector<RuleSettings> layers;
  std::string wanted = name.str();
  for (unsigned depth = 0; !wanted.empty(); ++depth) {
    const std::string file = "profiles/" + wanted + ".json";
    const auto found = llvm::find_if(builtinRulesetFiles(),
                                     [&](const RulesetFile &known) { return known.name == file; });
    if (found == builtinRulesetFiles().end() || depth == maxExtends)
      return failure(unknownProfile(wanted));
    auto json = parseJson(found->name, found->text);
    if (!json)
      return json.takeError();
    const JsonLayer layer{found->name.str(), found->text};
    JsonReader in(layer, *json);
    ProfileFile profile;
    readInto(in, *json, profileRecord, profile);
    RuleSettings rules;
    if (!in.failed())
      takeRuleSettings(in, *json, std::move(profile.rules), rules);
    wanted = profile.extends;
    if (llvm::Error wrong = in.takeError())
      return wrong;
    layers.insert(layers.begin(), std::move(rules));
  }
  return layers;
}

std::vector<std::string> profileNames() {
  std::vector<std::string> names;
  for (const RulesetFile &file : builtinRulesetFiles()) {
    llvm::StringRef name = file.name;
    if (name.consume_front("profiles/") && name.consume_back(".json"))
      names.push_back(name.str());
  }
  return names;
}

llvm::Expected<MachineSource> readMachine(const std::string &file) {
  auto text = readText(file);
  if (!text)
    return text.takeError();
  return MachineSource{file, std::move(*text)};
}

} // namespace ncvet
