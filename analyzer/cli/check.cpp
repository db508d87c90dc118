// `ncvet check`: inputs to findings to reports, and the exit code.
#include "analyzer/cli/check.h"

#include "analyzer/check/baseline.h"
#include "analyzer/check/fix.h"
#include "analyzer/cli/progress.h"
#include "analyzer/cli/views.h"
#include "analyzer/rule/rule_table.h"
#include "analyzer/setup/input_files.h"
#include "formats/finding/fingerprint.h"
#include "formats/reports/report_formats.h"
#include "formats/text/crash_guard.h"
#include "formats/text/diff.h"

#include "llvm/ADT/StringSet.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Format.h"
#include "llvm/Support/TimeProfiler.h"
#include "llvm/Support/raw_ostream.h"

#include <atomic>
#include <chrono>
#include <set>
#include <thread>

namespace ncvet::cli {

namespace {

/// One input with what became of it.
struct Job {
  Input input;
  const SourceFile *source = nullptr;
  FixedText fixed;
  FileOutcome outcome;
  std::optional<ProgramView> view; ///< when a report shows programs
};

class Check {
public:
  explicit Check(CheckRequest request) : request_(std::move(request)), session_(request_.session) {}

  int run();

private:
  void readStandardInput(Job &job);
  void collect();
  void forEachJob(const char *what, llvm::function_ref<void(Job &)> work);
  void openJob(Job &job);
  void writeFixes();
  void dropUsedSuppressions(std::vector<CheckedFinding> &findings);
  void addFingerprints(std::vector<CheckedFinding> &findings);
  void addFindings();
  void applyBaseline();
  bool showsPrograms() const;
  void buildReport();
  void writeTo(const ReportTarget &target);
  void writeReports();
  void writeStats() const;
  void writeGuess() const;
  void problem(llvm::StringRef path, const std::string &message);

  CheckRequest request_;
  Session session_;
  SourceSet sources_;
  std::vector<Job> jobs_;
  std::vector<RuleInfo> rules_;
  Report report_;
  llvm::StringSet<> said_; ///< problems that were told already
  bool failed_ = false;    ///< something could not be read: exit code 2
  bool found_ = false;     ///< a finding at or above the level
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

void Check::problem(llvm::StringRef path, const std::string &message) {
  failed_ = true;
  report_.notifications.push_back({Severity::Error, message, path.str()});
  // A bad configuration concerns many files and is told once.
  if (said_.insert(message).second)
    fail(message);
}

void Check::readStandardInput(Job &job) {
  auto text = llvm::MemoryBuffer::getSTDIN();
  if (!text) {
    job.outcome.error = "cannot read standard input: " + text.getError().message();
    return;
  }
  // With a name, it is checked as if it was there: configuration and subprograms are found.
  if (!request_.stdinFilename.empty())
    job.input.display = request_.stdinFilename;
  job.source = &sources_.add(job.input.display, (*text)->getBuffer(), request_.stdinFilename);
}

void Check::collect() {
  Inputs inputs = collectInputs(request_.paths, session_);
  for (const std::string &error : inputs.errors)
    problem("", error);
  std::vector<std::string> files;
  for (const Input &input : inputs.files)
    files.push_back(input.path);
  session_.folders()->setChecked(files);
  for (Input &input : inputs.files) {
    jobs_.push_back({std::move(input), nullptr, {}, {}, {}});
    if (jobs_.back().input.path == "-")
      readStandardInput(jobs_.back());
  }
}

void Check::openJob(Job &job) {
  if (job.source || !job.outcome.error.empty())
    return;
  auto source = sources_.open(job.input.path, job.input.display);
  if (source)
    job.source = *source;
  else
    job.outcome.error = llvm::toString(source.takeError());
}

void Check::forEachJob(const char *what, llvm::function_ref<void(Job &)> work) {
  Progress progress(what, jobs_.size());
  std::atomic<size_t> next = 0;
  const auto run = [&] {
    for (size_t index; (index = next++) < jobs_.size(); progress.step()) {
      const llvm::TimeTraceScope trace(what, jobs_[index].input.display);
      work(jobs_[index]);
    }
  };
  size_t workers = request_.jobs ? request_.jobs : std::thread::hardware_concurrency();
  workers = std::min(std::max<size_t>(1, workers), jobs_.size());
  if (workers <= 1)
    return run();
  std::vector<std::thread> threads;
  for (size_t worker = 0; worker < workers; ++worker)
    threads.emplace_back([&] {
      if (!request_.timeTrace.empty())
        llvm::timeTraceProfilerInitialize(0, "ncvet");
      run();
      if (!request_.timeTrace.empty())
        llvm::timeTraceProfilerFinishThread();
    });
  for (std::thread &thread : threads)
    thread.join();
}

/// Writes what was fixed, when all files have been looked at: no file is checked against programs
/// of which some are new and some old.
void Check::writeFixes() {
  for (Job &job : jobs_) {
    if (!job.source || !job.fixed.applied)
      continue;
    if (request_.diff) {
      writeUnifiedDiff(job.source->text(), job.fixed.text, job.input.display, llvm::outs());
      continue;
    }
    if (job.input.path != "-") {
      if (llvm::Error wrong = replaceFile(job.input.path, job.fixed.text)) {
        problem(job.input.display, llvm::toString(std::move(wrong)));
        continue;
      }
    }
    job.source = &sources_.add(job.input.display, job.fixed.text, job.source->path());
  }
}

void Check::addFingerprints(std::vector<CheckedFinding> &findings) {
  llvm::StringMap<Fingerprints> byFile;
  for (CheckedFinding &checked : findings) {
    Finding &finding = checked.finding;
    finding.fingerprint = byFile[sources_.get(finding.range.file).display()].next(
        rules_[finding.rule].id, checked.program, checked.blockText);
  }
}

/// A suppression in a subprogram may be needed by one of its callers only.
void Check::dropUsedSuppressions(std::vector<CheckedFinding> &findings) {
  std::set<std::pair<llvm::StringRef, uint32_t>> used;
  for (const Job &job : jobs_)
    for (const auto &[file, offset] : job.outcome.usedSuppressions)
      used.emplace(file, offset);
  if (used.empty())
    return;
  llvm::erase_if(findings, [&](const CheckedFinding &checked) {
    const Finding &finding = checked.finding;
    return rules_[finding.rule].id == "style-unused-suppression" &&
           used.count({sources_.get(finding.range.file).display(), finding.range.begin});
  });
}

void Check::addFindings() {
  std::vector<CheckedFinding> all;
  for (Job &job : jobs_)
    for (CheckedFinding &checked : job.outcome.findings) {
      if (request_.failOn)
        checked.failOn = *request_.failOn;
      all.push_back(std::move(checked));
    }
  const auto place = [&](const CheckedFinding &checked) {
    return placeInReport(report_, checked.finding);
  };
  // What is found in a program that several others call is told once: where every caller breaks the
  // rule first, then the one that is checked first.
  llvm::stable_sort(all, [&](const CheckedFinding &a, const CheckedFinding &b) {
    const auto left = place(a), right = place(b);
    return left != right ? left < right : a.finding.certainty > b.finding.certainty;
  });
  all.erase(std::unique(all.begin(), all.end(),
                        [&](const CheckedFinding &a, const CheckedFinding &b) {
                          return place(a) == place(b);
                        }),
            all.end());
  dropUsedSuppressions(all);
  addFingerprints(all);
  std::vector<FailOn> levels;
  for (CheckedFinding &checked : all) {
    report_.findings.push_back(std::move(checked.finding));
    levels.push_back(checked.failOn);
  }
  applyBaseline();
  for (size_t i = 0; i < levels.size(); ++i) {
    const Finding &finding = report_.findings[i];
    found_ |=
        !finding.suppressed && !finding.baselined && levels[i] && finding.severity >= *levels[i];
  }
}

void Check::applyBaseline() {
  if (!request_.baseline.empty()) {
    if (auto baseline = Baseline::load(request_.baseline)) {
      baseline->apply(report_.findings);
      report_.baselineUsed = true;
      llvm::StringSet<> files;
      for (const FileReport &file : report_.files)
        files.insert(file.path);
      for (KnownFinding &known : baseline->absent(files))
        report_.absent.push_back({std::move(known.rule), std::move(known.path),
                                  std::move(known.message), known.line, known.fingerprint});
    } else {
      problem("", llvm::toString(baseline.takeError()));
    }
  }
  if (!request_.writeBaseline.empty())
    if (llvm::Error wrong =
            writeBaseline(report_.findings, rules_, sources_, request_.writeBaseline))
      problem("", llvm::toString(std::move(wrong)));
}

/// Whether one of the reports shows programs whole.
bool Check::showsPrograms() const {
  const auto shows = [](llvm::StringRef name) {
    return llvm::any_of(reportFormats(), [&](const ReportFormat &format) {
      return format.name == name && format.showsPrograms;
    });
  };
  return shows(request_.format) || llvm::any_of(request_.reports, [&](const ReportTarget &target) {
           return shows(target.format);
         });
}

void Check::buildReport() {
  for (const RuleEntry &entry : allRules())
    rules_.push_back(entry.info);
  report_.toolVersion = NCVET_VERSION;
  report_.rules = rules_;
  report_.sources = &sources_;
  report_.colourNames = colourNames();
  for (Job &job : jobs_) {
    if (!job.outcome.error.empty()) {
      problem(job.input.display, job.outcome.error);
      continue;
    }
    report_.files.push_back({job.input.display, job.outcome.dialect, job.outcome.blocks,
                             job.outcome.complete, job.outcome.reason, job.outcome.guessed,
                             job.outcome.sure});
    if (job.view)
      report_.views.push_back(std::move(*job.view));
  }
  addFindings();
  sortReport(report_);
}

void Check::writeTo(const ReportTarget &target) {
  std::error_code error;
  llvm::raw_fd_ostream out(target.file, error);
  if (!error) {
    makeReportWriter(target.format)->write(report_, out);
    out.close();
    error = out.error();
    out.clear_error();
  }
  if (error)
    problem("", "cannot write " + target.file + ": " + error.message());
}

void Check::writeReports() {
  const bool fixedInput =
      request_.fix && llvm::any_of(jobs_, [](const Job &job) { return job.input.path == "-"; });
  if (fixedInput) { // a filter: standard output is the program
    for (const Job &job : jobs_)
      if (job.input.path == "-" && job.source)
        llvm::outs() << job.source->text();
  } else if (!request_.diff) {
    makeReportWriter(request_.format, {request_.color})->write(report_, llvm::outs());
  }
  llvm::outs().flush();
  if (llvm::outs().has_error()) {
    const std::error_code error = llvm::outs().error();
    llvm::outs().clear_error();
    problem("", "cannot write to standard output: " + error.message());
  }
  for (const ReportTarget &target : request_.reports)
    writeTo(target);
}

/// Says once which control was guessed, on standard error and to people only.
void Check::writeGuess() const {
  const Job *one = nullptr;
  std::map<std::string, size_t> files; ///< by dialect
  size_t guessed = 0;
  for (const Job &job : jobs_)
    if (job.outcome.guessed && job.outcome.error.empty()) {
      one = &job;
      ++files[job.outcome.dialect];
      ++guessed;
    }
  if (!one || failed_) // what went wrong comes first, and alone
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
    out << "; --stats says why";
  }
  out << "; --dialect names it\n";
}

void Check::writeStats() const {
  llvm::raw_ostream &out = llvm::errs();
  uint64_t blocks = 0;
  unsigned fixes = 0;
  for (const Job &job : jobs_) {
    if (!job.outcome.error.empty())
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
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  out << jobs_.size() << (jobs_.size() == 1 ? " file, " : " files, ") << blocks << " blocks, "
      << report_.findings.size() << " findings, " << fixes << " fixes, "
      << llvm::format("%.1f ms, %.0f blocks/s", seconds * 1e3, double(blocks) / seconds) << '\n';
}

int Check::run() {
  if (!request_.timeTrace.empty())
    llvm::timeTraceProfilerInitialize(0, "ncvet");
  collect();
  if (request_.fix || request_.diff) {
    forEachJob("fix", [&](Job &job) {
      openJob(job);
      if (job.source)
        job.fixed = fixText(session_, *job.source, request_.unsafeFixes);
    });
    writeFixes();
  }
  const bool views = showsPrograms();
  forEachJob("check", [&](Job &job) {
    openJob(job);
    if (!job.source)
      return;
    job.outcome = checkFile(session_, sources_, *job.source);
    if (views && job.outcome.error.empty())
      job.view = viewOf(session_, sources_, *job.source);
  });
  buildReport();
  writeReports();
  if (request_.stats)
    writeStats();
  else if (request_.format == "text")
    writeGuess();
  if (!request_.timeTrace.empty()) {
    if (llvm::Error wrong = llvm::timeTraceProfilerWrite(request_.timeTrace, "ncvet"))
      problem("", "cannot write " + request_.timeTrace + ": " + llvm::toString(std::move(wrong)));
    llvm::timeTraceProfilerCleanup();
  }
  return failed_ ? exitFailure : found_ ? exitFindings : exitClean;
}

} // namespace

int CheckCommand::run() {
  enableCrashGuard();
  auto request = options_.request();
  if (!request)
    return fail(llvm::toString(request.takeError()));
  return Check(std::move(*request)).run();
}

} // namespace ncvet::cli
