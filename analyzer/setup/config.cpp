// Configuration: reading `.ncvet.json` and profiles, with errors that name the line.
#include "analyzer/setup/config.h"

#include "formats/dialect/config_file.h"
#include "formats/dialect/json_reader.h"
#include "formats/dialect/ruleset_files.h"
#include "formats/text/failure.h"
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

/// Paths of a list, joined with the folder.
void takePaths(const std::optional<std::vector<std::string>> &given, llvm::StringRef folder,
               std::vector<std::string> &target) {
  if (!given)
    return;
  target.clear();
  for (const std::string &name : *given)
    target.push_back(joined(folder, name));
}

void takeGlobs(JsonReader &in, const Json &json, const char *key,
               std::optional<std::vector<std::string>> &&given, std::vector<std::string> &target) {
  if (!given)
    return;
  checkEach(in, json, key, *given, [](llvm::StringRef text) -> llvm::Error {
    auto glob = llvm::GlobPattern::create(text);
    return glob ? llvm::Error::success()
                : failure("a glob is expected: " + messageOf(glob.takeError()));
  });
  target = std::move(*given);
}

class ConfigReader {
public:
  explicit ConfigReader(Config &config) : config_(config) {}

  llvm::Error read(llvm::StringRef file, unsigned depth);

private:
  llvm::Error readExtended(JsonReader &in, const Json &json, const ConfigFile &given,
                           llvm::StringRef folder, unsigned depth);
  void readMachine(JsonReader &in, const Json &json, llvm::StringRef file, llvm::StringRef text,
                   llvm::StringRef folder);

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

void ConfigReader::readMachine(JsonReader &in, const Json &json, llvm::StringRef file,
                               llvm::StringRef text, llvm::StringRef folder) {
  const Json *machine = in.member(json, "machine");
  if (!machine)
    return;
  if (machine->is_object()) {
    const llvm::StringRef inside = findJsonMember(text, "machine").value_or(text);
    // Empty lines before it keep the line numbers of messages right.
    const unsigned line = lineAt(text, size_t(inside.data() - text.data()));
    config_.machine = MachineSource{file.str(), std::string(line - 1, '\n') + inside.str()};
  } else if (machine->is_string()) {
    const std::string name = joined(folder, machine->get_ref<const std::string &>());
    config_.readFrom.push_back(name);
    if (auto profile = readText(name))
      config_.machine = MachineSource{name, std::move(*profile)};
    else
      in.fail(*machine, messageOf(profile.takeError()));
  } else {
    in.fail(*machine, "a path or a machine profile { … } is expected");
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
  takeRuleSettings(in, *json, std::move(given.rules), config_.rules);
  if (const auto &name = given.dialect) {
    config_.dialect = llvm::StringRef(*name).endswith(".json") ? joined(folder, *name) : *name;
    const auto place = findJsonPlace(*text, JsonPath{{"dialect", 0, false}});
    config_.dialectPlace =
        (file + ":" + llvm::Twine(lineAt(*text, place.value_or(0))) + ": dialect").str();
  }
  takePaths(given.dialects, folder, config_.dialectFiles);
  takePaths(given.searchFolders, folder, config_.searchFolders);
  readMachine(in, *json, file, *text, folder);
  takeGlobs(in, *json, "files", std::move(given.files), config_.files);
  takeGlobs(in, *json, "exclude", std::move(given.exclude), config_.exclude);
  if (given.failOn)
    config_.failOn = llvm::cantFail(parseFailOn(failOnNames()[*given.failOn]));
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
        return std::string(file);
      // In the folder itself it is named as the user named the folder.
      file = folder;
      path::append(file, configFileName);
      return std::string(file);
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
