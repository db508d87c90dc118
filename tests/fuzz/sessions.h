// Sessions for fuzzing, one a dialect.
#pragma once

#include "analyzer/rule/rule.h"
#include "analyzer/setup/session.h"
#include "formats/dialect/loader.h"

#include <cstdlib>
#include <memory>

namespace ncvet::fuzz {

/// Session for dialect number `which` (any number), kept over all inputs: tables are loaded once.
inline Session &sessionOf(size_t which) {
  static const std::vector<DialectSummary> dialects = [] {
    std::vector<DialectSummary> all = listDialects();
    llvm::erase_if(all, [](const DialectSummary &d) { return d.abstract; });
    return all;
  }();
  static std::vector<std::unique_ptr<Session>> sessions(dialects.size() + 1);
  if (allRules().empty()) // names the rules' library to the linker
    std::abort();
  which %= sessions.size();
  if (!sessions[which]) {
    SessionOptions options;
    options.dialect = which == dialects.size() ? "auto" : dialects[which].id;
    options.profile = "all";
    options.limits.repeatedBlocks = 20'000; // loops that count for ever are no hang
    sessions[which] = std::make_unique<Session>(options);
  }
  return *sessions[which];
}

} // namespace ncvet::fuzz
