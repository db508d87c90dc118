// What the findings of a check are compared with.
#pragma once

#include "analyzer/check/baseline.h"
#include "analyzer/cli/changes.h"
#include "analyzer/cli/check_options.h"

namespace ncvet::cli {

struct Comparisons {
  std::optional<Baseline> baseline;
  std::optional<ChangedLines> changes;

  /// As the request names them. An error says which of them cannot be read.
  static llvm::Expected<Comparisons> load(const CheckRequest &request);
};

} // namespace ncvet::cli
