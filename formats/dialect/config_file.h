// What configurations, profiles of rules and the table of detection hold, as their files have it.
#pragma once

#include "formats/dialect/records.h"

#include <map>

namespace ncvet {

/// Choices of rules by id, category or `all`; none: the file does not say.
struct RuleChoices {
  std::optional<std::vector<std::string>> select, extendSelect, ignore;
};

/// A `.ncvet.json`; none: the file does not say. `machine`, `severity` and `options` are read by
/// those who know profiles and rules.
struct ConfigFile {
  std::optional<std::string> extends, dialect;
  std::optional<std::vector<std::string>> dialects;
  RuleChoices rules;
  std::optional<uint8_t> failOn; ///< index in `failOnNames`
  std::optional<std::vector<std::string>> searchFolders, files, exclude;
};
/// What a configuration says of some of its files; none: nothing. `machine`, `severity` and
/// `options` are read by those who know profiles and rules.
struct OverrideFile {
  std::vector<std::string> files; ///< globs
  std::optional<std::string> dialect;
  RuleChoices rules;
  std::optional<uint8_t> failOn; ///< index in `failOnNames`
  std::optional<std::vector<std::string>> searchFolders;
};
/// "error", "warning", "style", "never".
llvm::ArrayRef<llvm::StringLiteral> failOnNames();

/// A profile of rules.
struct ProfileFile {
  std::string title, extends;
  RuleChoices rules;
};

/// What is reported when the control is a guess.
struct UnsureFile {
  std::vector<std::string> ignore;
  std::optional<Severity> highest;
  /// Categories, of texts for controls without a table: that are told of every one, and that are
  /// not told even of one whose language is nearly the same.
  std::vector<std::string> toldOfOthers, differsInAlike;
};

/// How the control of a program is found out.
struct DetectFile {
  std::string fallback;
  std::vector<std::string> prefer;
  int minimumScore = 0, sureScore = 0, mostByHabits = 0;
  std::vector<std::string> habits; ///< patterns of marks
  UnsureFile unsure;
  std::map<std::string, OtherControlFile> otherControls; ///< by their names
  std::vector<std::string> extensions, looseExtensions;
};

/// The built-in table of detection.
llvm::Expected<DetectFile> loadDetection();

// config_records.cpp
extern const RecordOf<ConfigFile> configRecord;
extern const RecordOf<OverrideFile> overrideRecord;
extern const RecordOf<ProfileFile> profileRecord;
extern const RecordOf<DetectFile> detectRecord;

} // namespace ncvet
