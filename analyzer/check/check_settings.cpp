// The settings of a check as a text. Each struct is taken apart by a declaration that names all its
// fields: one that is new, and that findings may rest on, does not compile before it is looked at.
#include "analyzer/check/check_settings.h"

#include "llvm/Support/Path.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet {

namespace {

class SettingsWriter {
public:
  SettingsWriter(LookupAnswers &answers, llvm::raw_ostream &out) : answers_(answers), out_(out) {}

  void write(const SessionOptions &options) {
    const auto &[dialect, usual, machine, configFile, profile, rules, limits, contours] = options;
    table(dialect);
    text(usual);
    write(machine);
    text(configFile);
    text(profile);
    write(rules);
    const auto &[repeatedBlocks, callDepth, findingsPerRule, memory] = limits;
    out_ << repeatedBlocks << ' ' << callDepth << ' ' << findingsPerRule << ' ' << memory << ' '
         << contours << '\n';
  }

  /// `files`, `exclude` and `overrides` say which files are meant, and how `config` was made.
  void write(const Config &config) {
    const auto &[file, folder, readFrom, profile, rules, furtherRules, dialect, dialectPlace,
                 dialectFiles, machine, searchFolders, files, exclude, failOn, overrides, setBy,
                 given] = config;
    text(file);
    text(profile);
    write(rules);
    for (const RuleSettings &layer : furtherRules)
      write(layer);
    table(dialect);
    text(dialectPlace);
    for (const std::string &one : dialectFiles)
      table(one);
    write(machine);
    for (const std::string &one : searchFolders)
      text(one);
    out_ << (failOn ? *failOn ? int(**failOn) : -1 : -2) << '\n';
    for (const auto &[key, place] : setBy) { // told as reasons
      text(key);
      text(place);
    }
  }

private:
  /// With its length: no two lists of texts are written alike.
  void text(llvm::StringRef one) { out_ << one.size() << ' ' << one << '\n'; }

  void table(llvm::StringRef dialect) {
    text(dialect);
    if (!dialect.endswith(".json"))
      return;
    // A table finds those that it extends beside it.
    const llvm::StringRef folder = llvm::sys::path::parent_path(dialect);
    out_ << answers_.of({Lookup::Kind::Files, folder.empty() ? "." : folder.str(), ".json"})
         << '\n';
  }

  void write(const std::optional<MachineSource> &machine) {
    out_ << machine.has_value() << '\n';
    if (!machine)
      return;
    const auto &[name, profile] = *machine;
    text(name);
    text(profile);
  }

  void write(const RuleSettings &rules) {
    const auto &[select, extendSelect, ignore, severity, options] = rules;
    for (const std::vector<std::string> *names : {&select, &extendSelect, &ignore}) {
      out_ << names->size() << '\n';
      for (const std::string &name : *names)
        text(name);
    }
    out_ << severity.size() << '\n';
    for (const auto &[rule, level] : severity) {
      text(rule);
      out_ << int(level) << '\n';
    }
    out_ << options.size() << '\n';
    for (const auto &[rule, name, value] : options) {
      text(rule);
      text(name);
      if (const double *number = std::get_if<double>(&value))
        out_ << llvm::DoubleToBits(*number) << '\n';
      else
        text(std::get<std::string>(value));
    }
  }

  LookupAnswers &answers_;
  llvm::raw_ostream &out_;
};

} // namespace

std::string settingsText(const SessionOptions &options, const Config &config,
                         LookupAnswers &answers) {
  std::string text;
  llvm::raw_string_ostream out(text);
  SettingsWriter writer(answers, out);
  writer.write(options);
  writer.write(config);
  return out.str();
}

} // namespace ncvet
