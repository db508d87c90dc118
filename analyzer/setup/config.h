// Configuration: the nearest `.ncvet.json`, and the rule selections called profiles.
#pragma once

#include "analyzer/rule/rule_settings.h"

#include <map>

namespace ncvet {

/// The least severity that makes a check fail; none: never.
using FailOn = std::optional<Severity>;
/// `error`, `warning`, `style` or `never`.
llvm::Expected<FailOn> parseFailOn(llvm::StringRef text);

/// A machine profile as a configuration or a command line names it.
struct MachineSource {
  std::string name; ///< file name for messages, and the key that tells profiles apart
  std::string text; ///< JSON; of a profile inside a configuration with as many lines before it
};

/// Reads the file of a profile; the error names it.
llvm::Expected<MachineSource> readMachine(const std::string &file);

/// What a configuration says of some of its files; none: nothing.
struct ConfigOverride {
  std::vector<std::string> files; ///< globs
  std::string folder;             ///< that the globs are relative to
  std::string place;              ///< "FILE: overrides[0]"
  RuleSettings rules;
  std::optional<std::string> dialect;
  std::string dialectPlace; ///< as that of `Config`
  std::optional<MachineSource> machine;
  std::optional<std::vector<std::string>> searchFolders;
  std::optional<FailOn> failOn;
  std::map<std::string, std::string> given; ///< as that of `Config`
};

/// What a `.ncvet.json` says. Paths in it are relative to its own folder; here they are joined.
struct Config {
  std::string file;                  ///< empty: there is none
  std::string folder;                ///< folder of `file`
  std::vector<std::string> readFrom; ///< all files that it comes from: extended ones, a machine's
  std::string profile = "recommended";
  RuleSettings rules;
  std::vector<RuleSettings> furtherRules; ///< of overrides that count, laid over `rules` in turn
  std::string dialect;                    ///< id, or path of a table; empty: find out
  std::string dialectPlace;               ///< where it is said, for messages
  std::vector<std::string> dialectFiles;  ///< tables of one's own
  std::optional<MachineSource> machine;
  std::vector<std::string> searchFolders; ///< for programs that are called
  std::vector<std::string> files;         ///< globs: further programs in folders
  std::vector<std::string> exclude;       ///< globs: not these, when folders are checked
  std::optional<FailOn> failOn;
  std::vector<ConfigOverride> overrides;    ///< for some of the files
  std::map<std::string, std::string> setBy; ///< which file gave a key
  std::map<std::string, std::string> given; ///< value of a key as JSON text, as far as it is told
};

/// Reads the configuration `file`, with those that it extends. An error names file and line, and
/// what is expected there.
llvm::Expected<Config> loadConfig(llvm::StringRef file);

/// The configuration with what those of its overrides say whose index is in `which`, in this order.
Config overridden(const Config &config, llvm::ArrayRef<size_t> which);

/// Name of configurations in the folders of programs.
constexpr llvm::StringLiteral configFileName = ".ncvet.json";

/// The configuration that counts for files in `folder`: the nearest upward. Empty: none.
std::string findConfig(llvm::StringRef folder);

/// Layers of a profile, base first.
llvm::Expected<std::vector<RuleSettings>> loadProfile(llvm::StringRef name);
/// Names of the built-in profiles.
std::vector<std::string> profileNames();

} // namespace ncvet
