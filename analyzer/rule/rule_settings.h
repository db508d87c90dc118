// Rule settings: layers of choices, from a profile to the command line, and what comes of them.
#pragma once

#include "analyzer/rule/selection.h"

#include "llvm/Support/Error.h"

namespace ncvet {

/// One layer of choices. A rule is named by its id, its category, or `all`.
struct RuleSettings {
  std::vector<std::string> select;       ///< only these; empty: those of the layer below
  std::vector<std::string> extendSelect; ///< these as well
  std::vector<std::string> ignore;       ///< but not these
  std::vector<std::pair<std::string, Severity>> severity; ///< rule or category; later ones win
  struct Number {
    std::string rule, option;
    double value;
  };
  std::vector<Number> options;
};

/// Ids of the rules that `name` means; an error with a near name when there is none.
llvm::Expected<std::vector<RuleId>> rulesNamed(llvm::StringRef name);

/// The same; empty when there is none.
std::vector<RuleId> rulesCalled(llvm::StringRef name);

/// Lays `settings` over `selection`. All names in it must have been checked by `rulesNamed`.
void applySettings(RuleSelection &selection, const RuleSettings &settings);

/// An error that says what is expected when the rule has no such option or takes no such value.
llvm::Error checkRuleOption(const RuleSettings::Number &number);

} // namespace ncvet
