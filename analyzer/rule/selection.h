// Which rules run on a file.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/finding/finding.h"

#include "llvm/ADT/StringMap.h"

#include <optional>
#include <vector>

namespace ncvet {

/// Which rules run and how severe their findings are. Indexed like `allRules()`.
struct RuleSelection {
  std::vector<bool> enabled;
  /// Rules that the user selected, by name, category or `all`: their advice is wanted too.
  std::vector<bool> asked;
  /// Rules that the user switched off, whatever the name under which a control's table tells them.
  std::vector<bool> ignored;
  /// Severity that the user set; none: the table's or the rule's own.
  std::vector<std::optional<Severity>> severity;
  /// Options that the user set, over those of the dialect.
  llvm::StringMap<llvm::StringMap<OptionValue>> options;
  /// No finding is more severe unless the user set the rule's severity.
  Severity highest = Severity::Error;

  /// Every rule with its own default, changed by the dialect's table.
  static RuleSelection defaults(const Dialect &dialect);
  static RuleSelection everything();
};

} // namespace ncvet
