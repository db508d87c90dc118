// Settings of the client: the same choices as on the command line, and those of the editor alone.
#include "lsp/server/settings.h"

#include "analyzer/rule/rule_settings.h"

#include <set>

namespace ncvet::lsp {

namespace {

using Json = nlohmann::json;

constexpr const char *root = "ncvet"; ///< the section that holds all
/// What clients keep in the section for themselves: where ncvet is, and what they write down of it.
constexpr llvm::StringLiteral ofClients[] = {"path", "trace"};

class Section {
public:
  /// `names`: every setting that is asked for is added.
  Section(const Json &json, std::string name, std::vector<std::string> &problems,
          std::vector<std::string> &names)
      : json_(json), name_(std::move(name)), problems_(problems), names_(names) {}

  void read(const char *key, bool &into) const {
    ask(key);
    if (const Json *value = find(key, &Json::is_boolean, "true or false"))
      into = *value;
  }
  void read(const char *key, unsigned &into) const {
    ask(key);
    if (const Json *value = find(key, &Json::is_number_unsigned, "a whole number"))
      into = unsigned(std::min<uint64_t>(value->get<uint64_t>(), 1000000));
  }
  void read(const char *key, std::string &into) const {
    ask(key);
    if (const Json *value = find(key, &Json::is_string, "a text"))
      into = *value;
  }
  /// Names of rules, each of which must exist.
  void read(const char *key, std::vector<std::string> &into) const {
    ask(key);
    const Json *value = find(key, &Json::is_array, "a list of rules");
    for (const Json &rule : value ? *value : Json::array())
      if (rule.is_string() && isRule(key, rule))
        into.push_back(rule);
  }
  /// A section whose keys are settings.
  Section section(const char *key) const {
    known_.insert(key);
    return inner(key);
  }
  /// A setting whose keys are not.
  Section table(const char *key) const {
    ask(key);
    return inner(key);
  }
  const Json &json() const { return json_; }
  bool isRule(llvm::StringRef key, const std::string &rule) const {
    auto rules = rulesNamed(rule);
    if (rules)
      return true;
    complain(key, llvm::toString(rules.takeError()));
    return false;
  }
  void complain(llvm::StringRef key, const std::string &why) const {
    problems_.push_back((name_ + "." + key + ": " + why).str());
  }
  /// Of keys that nothing has asked for.
  void complainOfOthers() const {
    if (json_.is_object())
      for (const auto &[key, value] : json_.items())
        if (!known_.count(key))
          complain(key, "there is no such setting");
  }
  void allow(llvm::ArrayRef<llvm::StringLiteral> keys) const {
    known_.insert(keys.begin(), keys.end());
  }

private:
  Section inner(const char *key) const {
    const Json *value = find(key, &Json::is_object, "an object");
    return Section(value ? *value : empty(), name_ + "." + key, problems_, names_);
  }
  void ask(const char *key) const {
    known_.insert(key);
    names_.push_back(name_ + "." + key);
  }
  static const Json &empty() {
    static const Json object = Json::object();
    return object;
  }
  const Json *find(const char *key, bool (Json::*is)() const, const char *wanted) const {
    if (!json_.is_object())
      return nullptr;
    const auto found = json_.find(key);
    if (found == json_.end() || found->is_null())
      return nullptr;
    if (((*found).*is)())
      return &*found;
    complain(key, std::string("expected ") + wanted);
    return nullptr;
  }

  const Json &json_;
  std::string name_;
  std::vector<std::string> &problems_, &names_;
  mutable std::set<std::string, std::less<>> known_;
};

Settings read(const Json &json, std::vector<std::string> &problems,
              std::vector<std::string> &names) {
  Settings settings;
  const Section all(json, root, problems, names);
  all.allow(ofClients);
  all.read("dialect", settings.session.dialect);
  if (settings.session.dialect.empty())
    settings.session.dialect = "auto";
  all.read("config", settings.session.configFile);
  all.read("profile", settings.session.profile);
  all.read("machine", settings.machineFile);
  if (!settings.machineFile.empty()) {
    if (auto source = readMachine(settings.machineFile))
      settings.session.machine = std::move(*source);
    else
      all.complain("machine", llvm::toString(source.takeError()));
  }
  all.read("select", settings.session.rules.select);
  all.read("ignore", settings.session.rules.ignore);
  const Section severity = all.table("severity");
  if (severity.json().is_object())
    for (const auto &[rule, level] : severity.json().items()) {
      const auto parsed =
          level.is_string() ? parseSeverity(level.get<std::string>()) : std::nullopt;
      if (!parsed)
        severity.complain(rule, "expected error, warning or style");
      else if (severity.isRule(rule, rule))
        settings.session.rules.severity.emplace_back(rule, *parsed);
    }
  all.read("workspaceDiagnostics", settings.workspaceDiagnostics);
  const Section hints = all.section("hints");
  hints.read("units", settings.hints.units);
  hints.read("values", settings.hints.values);
  hints.read("motion", settings.hints.motion);
  const Section format = all.section("format");
  format.read("spaces", settings.format.spaces);
  format.read("renumber", settings.format.renumber);
  format.read("firstNumber", settings.format.firstNumber);
  for (const Section *section : {&all, &hints, &format})
    section->complainOfOthers();
  return settings;
}

} // namespace

Settings readSettings(const Json &json, std::vector<std::string> &problems) {
  std::vector<std::string> names;
  return read(json, problems, names);
}

std::vector<std::string> settingNames() {
  std::vector<std::string> problems, names;
  read(Json::object(), problems, names);
  for (std::string &name : names)
    name.erase(0, llvm::StringRef(root).size() + 1);
  llvm::sort(names);
  return names;
}

} // namespace ncvet::lsp
