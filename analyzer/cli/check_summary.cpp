// The last lines of `ncvet check`: what was found and fixed, which controls were guessed.
#include "analyzer/cli/check_job.h"
#include "formats/finding/finding_counts.h"

#include "llvm/Support/Format.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet::cli {

namespace {

/// "1 finding", "3 findings".
std::string counted(size_t number, llvm::StringRef what, llvm::StringRef plural = "s") {
  return (llvm::Twine(number) + " " + what + (number == 1 ? "" : plural)).str();
}

void writeFound(const FindingCounts &counts, const Report &report, llvm::raw_ostream &out) {
  if (counts.shown == 0) {
    uint64_t blocks = 0;
    for (const FileReport &file : report.files)
      blocks += file.blocks;
    out << "no findings in " << counted(report.files.size(), "file") << ", "
        << counted(blocks, "block");
  } else {
    out << counted(counts.shown, "finding") << " in " << counts.files.size() << " of "
        << counted(std::max(report.files.size(), counts.files.size()), "file") << ": ";
    llvm::StringRef separator;
    for (const Severity severity : {Severity::Error, Severity::Warning, Severity::Style})
      if (const size_t number = counts.of(severity)) {
        out << separator
            << (severity == Severity::Style ? std::to_string(number) + " style"
                                            : counted(number, toString(severity)));
        separator = ", ";
      }
  }
  if (counts.known)
    out << "; " << counts.known << " known from the baseline";
  if (counts.silenced)
    out << "; " << counts.silenced << " silenced by comments";
  out << '\n';
}

/// How to get the fixes that there are.
void writeFixable(const FindingCounts &counts, const CheckRequest &request,
                  llvm::raw_ostream &out) {
  const bool unsafeToo = request.unsafeFixes && (request.fix || request.diff);
  const size_t safe = request.fix || request.diff ? 0 : counts.safe;
  const size_t unsafe = unsafeToo ? 0 : counts.unsafe;
  if (!safe && !unsafe)
    return;
  out << "fixes: ";
  if (safe)
    out << safe << " safe (--diff shows, --fix writes)";
  if (unsafe)
    out << (safe ? ", " : "") << unsafe
        << " unsafe (--diff --unsafe-fixes shows, --fix=all writes)";
  out << '\n';
}

/// "fixed 3 findings in 2 files: style-lower-case 2, feed-missing 1".
void writeFixed(llvm::ArrayRef<Job> jobs, const CheckRequest &request, const Report &report,
                llvm::raw_ostream &out) {
  size_t files = 0, fixes = 0, most = 0, refused = 0, unsure = 0;
  std::map<llvm::StringRef, size_t> byRule;
  for (const Job &job : jobs) {
    files += job.fixed.applied > 0;
    fixes += job.fixed.applied;
    most += job.fixed.stoppedEarly;
    refused += job.fixed.refused;
    unsure += job.fixed.unsureControl;
    for (const auto &[rule, count] : job.fixed.byRule)
      byRule[report.rules[rule].id] += count;
  }
  out << (request.diff ? "would fix " : "fixed ") << counted(fixes, "finding") << " in "
      << counted(files, "file");
  llvm::StringRef separator = ": ";
  for (const auto &[rule, count] : byRule) {
    out << separator << rule << ' ' << count;
    separator = ", ";
  }
  out << '\n';
  if (unsure)
    out << "nothing was fixed in " << counted(unsure, "file")
        << " whose control is a guess; --dialect names it\n";
  if (refused)
    out << counted(refused, "fix", "es")
        << " left out: each would cause a new finding, or a motion that it does not name\n";
  if (most)
    out << "in " << counted(most, "file")
        << " fixes are left that another run applies: ncvet stops after so many rounds\n";
}

} // namespace

void writeSummary(const CheckRequest &request, llvm::ArrayRef<Job> jobs, const Report &report) {
  if (report.files.empty())
    return;
  llvm::raw_ostream &out = llvm::errs();
  const FindingCounts counts = countFindings(report.findings);
  if (request.fix || request.diff)
    writeFixed(jobs, request, report, out);
  if (!request.writeBaseline.empty()) {
    out << "wrote " << counted(counts.shown + counts.known, "finding") << " to "
        << (request.writeBaseline == "-" ? "standard output" : request.writeBaseline) << '\n';
    return;
  }
  writeFound(counts, report, out);
  writeFixable(counts, request, out);
}

void writeGuess(llvm::ArrayRef<Job> jobs) {
  const Job *one = nullptr;
  std::map<std::string, size_t> files; ///< by dialect
  size_t guessed = 0, unsure = 0;
  for (const Job &job : jobs)
    if (job.outcome.guessed && job.outcome.error.empty()) {
      one = &job;
      ++files[job.outcome.dialect];
      ++guessed;
      unsure += !job.outcome.sure;
    }
  if (!one)
    return;
  llvm::raw_ostream &out = llvm::errs();
  out << "control: ";
  if (guessed == 1) {
    out << one->outcome.dialect << ", guessed: " << one->outcome.reason;
  } else {
    out << "guessed for " << guessed << " files: ";
    llvm::StringRef separator;
    for (const auto &[dialect, count] : files) {
      out << separator << dialect << " (" << count << ')';
      separator = ", ";
    }
    if (unsure)
      out << "; not sure for " << unsure << ", where no finding is an error";
    out << "; --stats says why";
  }
  out << "; --dialect names it\n";
}

void writeCuts(llvm::ArrayRef<Job> jobs) {
  const Job *one = nullptr;
  size_t files = 0;
  for (const Job &job : jobs)
    if (!job.outcome.cuts.empty()) {
      one = &job;
      ++files;
    }
  if (!one)
    return;
  llvm::raw_ostream &out = llvm::errs();
  if (files == 1)
    out << one->input.display
        << ": cut short, findings may be missing: " << one->outcome.cuts.front() << '\n';
  else
    out << "cut short, findings may be missing: " << counted(files, "file")
        << "; --stats names them\n";
}

void writeStats(llvm::ArrayRef<Job> jobs, const Report &report, size_t known, double seconds) {
  llvm::raw_ostream &out = llvm::errs();
  uint64_t blocks = 0;
  unsigned fixes = 0;
  for (const Job &job : jobs) {
    if (!job.outcome.error.empty() || job.skipped)
      continue;
    out << job.input.display << ": " << job.outcome.dialect << " (" << job.outcome.reason << "), "
        << job.outcome.blocks << " blocks";
    if (job.fixed.applied)
      out << ", " << job.fixed.applied << " fixes in " << job.fixed.rounds << " rounds";
    out << '\n';
    for (const std::string &cut : job.outcome.cuts)
      out << job.input.display << ": cut short: " << cut << '\n';
    for (const std::string &contour : job.outcome.contours)
      out << job.input.display << ':' << contour << '\n';
    blocks += job.outcome.blocks;
    fixes += job.fixed.applied;
  }
  out << counted(jobs.size(), "file") << ", " << blocks << " blocks, " << report.findings.size()
      << " findings, " << fixes << " fixes, ";
  if (known)
    out << known << " known, ";
  out << llvm::format("%.1f ms, %.0f blocks/s", seconds * 1e3, double(blocks) / seconds) << '\n';
}

} // namespace ncvet::cli
