// Baseline: the findings that are known and need not be told again.
#pragma once

#include "formats/finding/finding.h"
#include "formats/text/source_set.h"

#include "llvm/ADT/StringSet.h"
#include "llvm/Support/Error.h"

#include <map>

namespace ncvet {

/// A finding as a baseline keeps it; equal ones (same rule and block text) are counted.
struct KnownFinding {
  uint64_t fingerprint = 0;
  std::string rule, path, message;
  uint32_t line = 1;
  unsigned count = 1;
};

/// What a baseline file says.
class Baseline {
public:
  /// Reads `file`. An error names the file, and line where there is one.
  static llvm::Expected<Baseline> load(llvm::StringRef file);

  /// Marks the findings that are known, in their order; those that comments silence as well.
  void apply(llvm::MutableArrayRef<Finding> findings);
  /// After `apply`: what was known of these files and did not occur again.
  std::vector<KnownFinding> absent(const llvm::StringSet<> &files) const;

private:
  std::map<uint64_t, KnownFinding> known_;
};

/// Writes all findings that are not suppressed as a baseline, in their order.
void writeBaseline(llvm::ArrayRef<Finding> findings, llvm::ArrayRef<RuleInfo> rules,
                   const SourceSet &sources, llvm::raw_ostream &out);

} // namespace ncvet
