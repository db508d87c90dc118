// The JSON files of rulesets/ that are compiled into the binary.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"

namespace ncvet {

struct RulesetFile {
  llvm::StringRef name; ///< path below rulesets/, e.g. "dialects/haas-lathe.json"
  llvm::StringRef text;
};

/// All built-in files, sorted by name.
llvm::ArrayRef<RulesetFile> builtinRulesetFiles();

} // namespace ncvet
