// What `ncvet check` knows of one input while it runs.
#pragma once

#include "analyzer/check/fix.h"
#include "analyzer/cli/check_options.h"
#include "analyzer/setup/input_files.h"
#include "formats/reports/report.h"

namespace ncvet::cli {

/// One input with what became of it.
struct Job {
  Input input;
  size_t index = 0;   ///< among all
  uint64_t bytes = 0; ///< 0: not known
  const SourceFile *source = nullptr;
  FixedText fixed;
  FileOutcome outcome;
  std::optional<ProgramView> view; ///< when a report shows programs
  bool skipped = false;            ///< found in a folder, and no program after all
};

/// Of all that was checked, for people and on standard error: how much was found, what can be fixed
/// and how, what was fixed.
void writeSummary(const CheckRequest &request, llvm::ArrayRef<Job> jobs, const Report &report);
/// Which controls were guessed, in one line; nothing when none was.
void writeGuess(llvm::ArrayRef<Job> jobs);
/// Which programs could not be followed to the end, in one line; nothing when none was.
void writeCuts(llvm::ArrayRef<Job> jobs);
/// `--stats`: of each file its control and its blocks, and the speed of all, of which so many were
/// known from an earlier run.
void writeStats(llvm::ArrayRef<Job> jobs, const Report &report, size_t known, double seconds);

} // namespace ncvet::cli
