// The facade: checks one program with everything that it calls.
#pragma once

#include "analyzer/program/project.h"
#include "analyzer/rule/rule.h"

#include <atomic>

namespace ncvet {

class StraightRuns;

/// Which rules run and how severe their findings are. Indexed like `allRules()`.
struct RuleSelection {
  std::vector<bool> enabled;
  /// Rules that the user selected, by name, category or `all`: their advice is wanted too.
  std::vector<bool> asked;
  /// Severity that the user set; none: the table's or the rule's own.
  std::vector<std::optional<Severity>> severity;
  /// Options that the user set, over those of the dialect.
  llvm::StringMap<llvm::StringMap<double>> options;
  /// No finding is more severe unless the user set the rule's severity.
  Severity highest = Severity::Error;

  /// Every rule with its own default, changed by the dialect's table.
  static RuleSelection defaults(const Dialect &dialect);
  static RuleSelection everything();
};

struct AnalysisResult {
  std::vector<Finding> findings; ///< sorted by file, position, rule; suppressions not yet applied
  uint64_t blocks = 0;           ///< blocks with content in the file
  bool complete = true;          ///< false: cut short by a budget
  std::vector<std::string> cuts; ///< why, one line each
};

/// Budgets, each with its reason. The defaults suit batch use.
struct AnalysisLimits {
  /// Blocks executed again (loops, calls), statements counted as several: one to two seconds.
  uint64_t repeatedBlocks = 3'000'000;
  /// Calls inside calls: no control allows more than ten, the rest is room for findings.
  unsigned callDepth = 32;
  /// Findings of one rule in one file: more are noise.
  unsigned findingsPerRule = 1000;
};

/// Checks the file `unit` of `project` with all that it calls. `cancel`, when given, ends the
/// analysis early (it is looked at every 256 blocks). `runs`, when given, holds what earlier
/// analyses of the file have followed, moved with its text, under the same rules; the result is the
/// same.
AnalysisResult analyze(Project &project, FileUnit &unit, const RuleSelection &rules,
                       const AnalysisLimits &limits = {}, const std::atomic<bool> *cancel = nullptr,
                       StraightRuns *runs = nullptr);

} // namespace ncvet
