// Which lookups a thread records.
#include "analyzer/program/lookups.h"

#include "formats/text/source.h"

#include "llvm/Support/xxhash.h"

#include <utility>

namespace ncvet {

namespace {

thread_local LookupRecord *recording = nullptr;

} // namespace

LookupRecord::LookupRecord(LookupSource &answers)
    : answers_(answers), outer_(std::exchange(recording, this)) {}

LookupRecord::~LookupRecord() { recording = outer_; }

LookupRecord *LookupRecord::current() { return recording; }

void LookupRecord::note(Lookup lookup) {
  const auto [at, fresh] = noted_.try_emplace(std::move(lookup));
  if (fresh)
    at->second = answers_.of(at->first);
}

void LookupRecord::noteText(const SourceFile &file) {
  const auto [at, fresh] = noted_.try_emplace({Lookup::Kind::Text, file.path(), ""});
  if (fresh)
    at->second = llvm::xxHash64(file.text());
}

} // namespace ncvet
