// `ncvet config`: what counts for a file or a folder, and who said so.
#include "analyzer/cli/config_command.h"
#include "analyzer/rule/rule_table.h"
#include "formats/text/json_text.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Format.h"
#include "llvm/Support/raw_ostream.h"
#include <nlohmann/json.hpp>

namespace ncvet::cli {

namespace {

using SettingJson = nlohmann::ordered_json; // keys in the order of insertion

/// A setting with who gave it.
struct Setting {
  std::string name;
  SettingJson value;
  std::string from;
};

/// Who gave a key of the configuration: the file, or nobody.
std::string fromFile(const Config &config, const std::string &key) {
  const auto file = config.setBy.find(key);
  return file == config.setBy.end() ? "default" : file->second;
}

SettingJson orNull(const std::string &text) {
  return text.empty() ? SettingJson(nullptr) : SettingJson(text);
}

class SettingsOf {
public:
  SettingsOf(const SessionOptions &options, const Config &config)
      : options_(options), config_(config) {}

  std::vector<Setting> list(const FileSetup *setup) {
    add("configuration", orNull(config_.file), options_.configFile.empty() ? "found" : "--config");
    addControl(setup);
    addMachine();
    if (!options_.profile.empty())
      add("profile", options_.profile, "--profile");
    else
      add("profile", config_.profile, fromFile(config_, "extends"));
    for (const char *key : {"select", "extendSelect", "ignore", "severity", "options"})
      if (config_.setBy.count(key))
        add(key, SettingJson::parse(config_.given.at(key), nullptr, false), fromFile(config_, key));
    add("failOn",
        config_.failOn ? *config_.failOn ? toString(**config_.failOn).str() : "never" : "error",
        fromFile(config_, "failOn"));
    add("searchFolders", config_.searchFolders, fromFile(config_, "searchFolders"));
    add("files", config_.files, fromFile(config_, "files"));
    add("exclude", config_.exclude, fromFile(config_, "exclude"));
    return std::move(settings_);
  }

private:
  void add(std::string name, SettingJson value, std::string from) {
    settings_.push_back({std::move(name), std::move(value), std::move(from)});
  }

  void addControl(const FileSetup *setup) {
    if (setup)
      return add("dialect", setup->dialect->id,
                 setup->detected ? "found out: " + setup->reason : setup->reason);
    if (options_.dialect != "auto")
      return add("dialect", options_.dialect, "--dialect");
    add("dialect", config_.dialect.empty() ? "auto" : config_.dialect,
        fromFile(config_, "dialect"));
  }

  void addMachine() {
    if (options_.machine)
      add("machine", options_.machine->name, "--machine");
    else if (config_.machine)
      add("machine", config_.machine->name, fromFile(config_, "machine"));
    else
      add("machine", nullptr, "default");
  }

  const SessionOptions &options_;
  const Config &config_;
  std::vector<Setting> settings_;
};

SettingJson rulesJson(const RuleSelection &selection) {
  SettingJson rules = SettingJson::object();
  for (size_t rule = 0; rule < allRules().size(); ++rule)
    if (selection.enabled[rule]) {
      const RuleInfo &info = allRules()[rule].info;
      rules[info.id.str()] = toString(selection.severity[rule].value_or(info.severity)).str();
    }
  return rules;
}

void writeSettings(llvm::ArrayRef<Setting> settings, llvm::raw_ostream &out) {
  for (const Setting &setting : settings) {
    std::string value = setting.value.is_null()     ? "none"
                        : setting.value.is_string() ? setting.value.get<std::string>()
                                                    : jsonText(setting.value);
    if (value == "[]")
      value = "none";
    out << llvm::left_justify(setting.name, 14) << "  " << value << "  (" << setting.from << ")\n";
  }
}

} // namespace

ConfigCommand::ConfigCommand()
    : Command("config", "show which settings count for a program, and who gave them") {
  setup_.declare(options);
  options.section("Options");
  options.add("--profile", &profile_, "selection of rules").valued("NAME").environment();
  options.add("--format", &format_, "text (default) or json").valued("FMT").among({"text", "json"});
  options.operands("PATH", path_, 0, 1);
}

int ConfigCommand::run() {
  SessionOptions given;
  given.profile = profile_;
  if (llvm::Error wrong = setup_.apply(given))
    return fail(std::move(wrong));
  Session session(given);
  const std::string path = path_.empty() ? "." : path_.front();
  std::optional<FileSetup> setup;
  std::shared_ptr<const Config> config;
  if (llvm::sys::fs::is_directory(path)) {
    auto found = session.config(path);
    if (!found)
      return fail(found.takeError());
    config = *found;
  } else {
    SourceSet sources;
    auto file = sources.open(path, path);
    if (!file)
      return fail(file.takeError());
    auto made = session.setup(path, (*file)->text());
    if (!made)
      return fail(made.takeError());
    setup = std::move(*made);
    config = setup->config;
  }
  const std::vector<Setting> settings = SettingsOf(given, *config).list(setup ? &*setup : nullptr);
  const size_t enabled = setup ? size_t(llvm::count(setup->rules->enabled, true)) : 0;
  if (format_ == "text") {
    llvm::outs() << llvm::left_justify("path", 14) << "  " << path << '\n';
    writeSettings(settings, llvm::outs());
    if (setup)
      llvm::outs() << llvm::left_justify("rules", 14) << "  " << enabled << " of "
                   << allRules().size() << " are on; --format json lists them\n";
    return exitClean;
  }
  SettingJson json = {{"version", 1}, {"path", path}, {"settings", SettingJson::object()}};
  for (const Setting &setting : settings)
    json["settings"][setting.name] = {{"value", setting.value}, {"from", setting.from}};
  if (setup)
    json["rules"] = rulesJson(*setup->rules);
  llvm::outs() << jsonText(json) << '\n';
  return exitClean;
}

} // namespace ncvet::cli
