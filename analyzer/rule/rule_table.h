// The rules of the build.
#pragma once

#include "formats/finding/finding.h"

#include "llvm/ADT/ArrayRef.h"

#include <memory>

namespace ncvet {

class Rule;

/// What is known of a rule without asking it, and how it is made.
struct RuleEntry {
  RuleInfo info;
  std::unique_ptr<Rule> (*make)();
};

/// Every rule of the build, sorted by category and id. Generated from the rules' pages.
llvm::ArrayRef<RuleEntry> allRules();

} // namespace ncvet
