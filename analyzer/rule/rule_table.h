// The rules of the build.
#pragma once

#include "formats/finding/finding.h"

#include "llvm/ADT/ArrayRef.h"

#include <memory>
#include <optional>

namespace ncvet {

class Rule;

/// What is known of a rule without asking it, and how it is made.
struct RuleEntry {
  RuleInfo info;
  std::unique_ptr<Rule> (*make)();
};

/// Every rule of the build, sorted by category and id. Generated from the rules' pages.
llvm::ArrayRef<RuleEntry> allRules();

/// The rule with this id; none: there is no such rule.
inline std::optional<RuleId> findRule(llvm::StringRef id) {
  const llvm::ArrayRef<RuleEntry> rules = allRules();
  for (size_t i = 0; i < rules.size(); ++i)
    if (rules[i].info.id == id)
      return RuleId(i);
  return std::nullopt;
}

} // namespace ncvet
