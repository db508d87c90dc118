// Whether what a check has looked up is still the same.
#pragma once

#include "analyzer/program/lookups.h"

#include <memory>
#include <mutex>

namespace ncvet {

class ProgramFolders;

/// Answers of one run, each a hash, found out when first asked for. Safe for several threads.
class LookupAnswers final : public LookupSource {
public:
  /// `folders`: those in which the run looks programs up.
  explicit LookupAnswers(std::shared_ptr<ProgramFolders> folders) : folders_(std::move(folders)) {}

  uint64_t of(const Lookup &lookup) override;

private:
  uint64_t findOut(const Lookup &lookup) const;

  std::shared_ptr<ProgramFolders> folders_;
  std::mutex mutex_;
  std::map<Lookup, uint64_t> known_;
};

} // namespace ncvet
