// Settings of the client: the same choices as on the command line, and those of the editor alone.
#include "lsp/server/settings.h"

#include "analyzer/rule_settings.h"

namespace ncvet::lsp {

namespace {

using Json = nlohmann::json;

class Section {
public:
  Section(const Json &json, std::string name, std::vector<std::string> &problems)
      : json_(json), name_(std::move(name)), problems_(problems) {}

  void read(const char *key, bool &into) const {
    if (const Json *value = find(key, &Json::is_boolean, "true or false"))
      into = *value;
  }
  void read(const char *key, unsigned &into) const {
    if (const Json *value = find(key, &Json::is_number_unsigned, "a whole number"))
      into = unsigned(std::min<uint64_t>(value->get<uint64_t>(), 1000000));
  }
  void read(const char *key, std::string &into) const {
    if (const Json *value = find(key, &Json::is_string, "a text"))
      into = *value;
  }
  /// Names of rules, each of which must exist.
  void read(const char *key, std::vector<std::string> &into) const {
    const Json *value = find(key, &Json::is_array, "a list of rules");
    for (const Json &rule : value ? *value : Json::array())
      if (rule.is_string() && isRule(key, rule))
        into.push_back(rule);
  }
  Section section(const char *key) const {
    const Json *value = find(key, &Json::is_object, "an object");
    return Section(value ? *value : empty(), name_ + "." + key, problems_);
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

private:
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
  std::vector<std::string> &problems_;
};

} // namespace

Settings readSettings(const Json &json, std::vector<std::string> &problems) {
  Settings settings;
  const Section all(json, "ncvet", problems);
  all.read("dialect", settings.session.dialect);
  if (settings.session.dialect.empty())
    settings.session.dialect = "auto";
  all.read("config", settings.session.configFile);
  all.read("profile", settings.session.profile);
  std::string machine;
  all.read("machine", machine);
  if (!machine.empty()) {
    if (auto source = readMachine(machine))
      settings.session.machine = std::move(*source);
    else
      all.complain("machine", llvm::toString(source.takeError()));
  }
  all.read("select", settings.session.rules.select);
  all.read("ignore", settings.session.rules.ignore);
  const Section severity = all.section("severity");
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
  return settings;
}

} // namespace ncvet::lsp
