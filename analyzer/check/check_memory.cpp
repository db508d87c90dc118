// What checks of one file keep for the next one.
#include "analyzer/check/check_memory.h"

#include "analyzer/reuse/run_cache.h"
#include "analyzer/setup/session.h"
#include "formats/text/formatted.h"

namespace ncvet {

CheckMemory::CheckMemory() : runs_(std::make_unique<StraightRuns>()) {}
CheckMemory::CheckMemory(CheckMemory &&) noexcept = default;
CheckMemory &CheckMemory::operator=(CheckMemory &&) noexcept = default;
CheckMemory::~CheckMemory() = default;

FileScan *CheckMemory::scanFor(const FileSetup &setup, const SourceFile &file,
                               const SharedText &text) {
  const bool same = text_ && dialect_ == setup.dialect && machine_ == setup.machine &&
                    rules_ == setup.rules && file_ == file.id();
  // On some controls a program of one's own may hide one of the control's.
  const bool hides = !setup.dialect->hiddenPrograms.empty() && folders_ != setup.folders;
  changes_.reset();
  if (same && !hides) {
    changes_ = changesBetween(text_, text);
    for (const TextChange &change : changes_->fromFront())
      scan_.edit(change, file);
  } else {
    scan_.clear();
  }
  checked_ &= same && !hides && text_ == text.bytes;
  text_ = text.bytes;
  dialect_ = setup.dialect;
  machine_ = setup.machine;
  rules_ = setup.rules;
  folders_ = setup.folders;
  file_ = file.id();
  return &scan_;
}

StraightRuns *CheckMemory::runsFor(const FileIndex &index) {
  std::string programs;
  for (const ProgramInfo &program : index.programs())
    programs += formatted("{0} {1} {2} {3}\n", program.number, program.name, int(program.kind),
                          program.hasHeader());
  if (!changes_ || programs_ != programs) {
    runs_->clear();
    checked_ = false;
  } else {
    for (const TextChange &change : changes_->fromFront())
      runs_->edit(change);
  }
  changes_ = TextChanges(); // the runs are those of this text now
  programs_ = std::move(programs);
  return runs_.get();
}

/// What a crash leaves can be neither used nor given back.
void CheckMemory::abandon() {
  new CheckMemory(std::move(*this)); // on purpose without an owner
  *this = CheckMemory();
}

uint64_t CheckMemory::blocks() const { return runs_->straight.blocks(); }

TakenRuns CheckMemory::takeTaken() { return std::exchange(runs_->taken, {}); }

} // namespace ncvet
