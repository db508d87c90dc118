// What one of the threads of `ncvet check` keeps.
#pragma once

#include "analyzer/check/check_cache.h"
#include "analyzer/check/check_store.h"
#include "analyzer/cli/check_job.h"

#include <map>
#include <tuple>

namespace ncvet::cli {

/// What the thread that checks some of the inputs keeps from one to the next.
struct Worker {
  CheckStore store;
  CheckCache::Opened opened;
  /// Findings in files that the inputs call, one for each rule and place: where every path breaks
  /// the rule first, then that of the first input. In a folder whose programs call one another each
  /// input finds them all again.
  std::map<std::tuple<FileId, uint32_t, uint32_t, RuleId>, std::pair<size_t, CheckedFinding>>
      inCalled;

  /// Takes those of one input out of its list.
  void keep(Job &job) {
    auto &all = job.outcome.findings;
    const auto own = [&](const CheckedFinding &checked) {
      return checked.finding.range.file == job.source->id();
    };
    for (CheckedFinding &checked : all) {
      const Finding &finding = checked.finding;
      if (own(checked))
        continue;
      const auto [known, fresh] = inCalled.try_emplace(
          {finding.range.file, finding.range.begin, finding.range.end, finding.rule});
      auto &[index, kept] = known->second;
      if (fresh || finding.certainty > kept.finding.certainty ||
          (finding.certainty == kept.finding.certainty && job.index < index)) {
        index = job.index;
        kept = std::move(checked);
      }
    }
    llvm::erase_if(all, [&](const CheckedFinding &checked) { return !own(checked); });
  }
};

} // namespace ncvet::cli
