// Rule settings: layers of choices, from a profile to the command line, and what comes of them.
#pragma once

#include "analyzer/rule/selection.h"

#include "llvm/Support/Error.h"
#include <nlohmann/json_fwd.hpp>

namespace ncvet {

/// One layer of choices. A rule is named by its id, its category, or `all`.
struct RuleSettings {
  std::vector<std::string> select;       ///< only these; empty: those of the layer below
  std::vector<std::string> extendSelect; ///< these as well
  std::vector<std::string> ignore;       ///< but not these
  std::vector<std::pair<std::string, Severity>> severity; ///< rule or category; later ones win
  struct Option {
    std::string rule, name;
    OptionValue value;
  };
  std::vector<Option> options;
};

/// Ids of the rules that `name` means; an error with a near name when there is none.
llvm::Expected<std::vector<RuleId>> rulesNamed(llvm::StringRef name);

/// The same; empty when there is none.
std::vector<RuleId> rulesCalled(llvm::StringRef name);

/// Lays `settings` over `selection`. All names in it must have been checked by `rulesNamed`.
void applySettings(RuleSelection &selection, const RuleSettings &settings);

/// The value of an option of a rule. An error says what is expected when there is no such rule or
/// option, or when it takes no such value; 0 and 1 are taken for false and true, and the index of a
/// name for the name.
llvm::Expected<OptionValue> readRuleOption(llvm::StringRef rule, llvm::StringRef option,
                                           const nlohmann::json &value);

/// Looks at `rules` of a table of the user's own, whose other keys its loading has checked: an
/// error names the file and the line of a rule or an option that ncvet does not have.
llvm::Error checkRulesOfTable(llvm::StringRef file, llvm::StringRef text);

} // namespace ncvet
