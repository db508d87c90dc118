// `ncvet check`: inputs to findings to reports, and the exit code.
#include "analyzer/cli/check.h"

#include "analyzer/cli/check_job.h"
#include "analyzer/cli/check_worker.h"
#include "analyzer/cli/comparisons.h"
#include "analyzer/cli/output.h"
#include "analyzer/cli/postponed_checks.h"
#include "analyzer/cli/relative_paths.h"
#include "analyzer/cli/views.h"
#include "analyzer/cli/watch.h"
#include "analyzer/cli/workers.h"
#include "analyzer/rule/rule_table.h"
#include "formats/finding/fingerprint.h"
#include "formats/reports/report_formats.h"
#include "formats/text/crash_guard.h"
#include "formats/text/diff.h"
#include "formats/text/plain_text.h"
#include "formats/text/read_file.h"
#include "formats/text/system/system.h"

#include "llvm/ADT/StringSet.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"
#include "llvm/Support/TimeProfiler.h"
#include "llvm/Support/raw_ostream.h"

#include <chrono>
#include <set>

namespace ncvet::cli {

namespace {

class Check {
public:
  Check(CheckRequest request, CheckRound *round)
      : request_(std::move(request)), session_(request_.session), round_(round) {}

  int run();

private:
  void readInput(Job &job);
  void collect();
  using Work = llvm::function_ref<void(Job &, Worker &)>;
  void forEachGroup(const char *what, std::vector<std::vector<Job *>> groups, Work work);
  void forEachJob(const char *what, Work work);
  void giveBack(Worker &&worker);
  void openJob(Job &job);
  void checkJob(Job &job, Worker &worker);
  void checkPostponed();
  FileOutcome outcomeOf(const SourceFile &file, Worker &worker);
  llvm::Error writeFix(const Job &job) const;
  void writeFixes();
  void dropUsedSuppressions(std::vector<CheckedFinding> &findings);
  void addFingerprints(std::vector<CheckedFinding> &findings);
  void addFindings();
  void applyBaseline();
  bool showsPrograms() const;
  bool isCancelled() const { return round_ && round_->cancel; }
  void noteRead();
  void buildReport();
  void writeTo(const std::string &file, llvm::function_ref<void(llvm::raw_ostream &)> write);
  void writeReport(const ReportTarget &target, llvm::raw_ostream &out) const;
  void writeReports();
  void writeLastLines() const;
  void problem(llvm::StringRef path, const std::string &message);
  void warn(llvm::StringRef path, const std::string &message);

  CheckRequest request_;
  Session session_;
  CheckRound *round_; ///< null: checked once
  SourceSet sources_;
  std::unique_ptr<CheckCache> cache_; ///< null: there is none
  std::vector<Job> jobs_;
  std::vector<RuleInfo> rules_;
  Comparisons compared_;
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

/// Something that is probably not meant, but that is no reason to fail.
void Check::warn(llvm::StringRef path, const std::string &message) {
  report_.notifications.push_back({Severity::Warning, message, path.str()});
  if (!request_.quiet)
    llvm::errs() << "ncvet: warning: " << message << '\n';
}

void Check::readInput(Job &job) {
  auto text = readStandardInput();
  if (!text) {
    job.outcome.error = llvm::toString(text.takeError());
    return;
  }
  // With a name, it is checked as if it was there: configuration and subprograms are found.
  if (!request_.stdinFilename.empty())
    job.input.display = request_.stdinFilename;
  if (const std::string why = whyNoProgram((*text)->getBuffer()); !why.empty())
    job.outcome.error = job.input.display + ": not checked: " + why;
  else
    job.source = &sources_.add(job.input.display, (*text)->getBuffer(), request_.stdinFilename);
}

void Check::collect() {
  Inputs inputs = collectInputs(request_.paths, session_, request_.inputs);
  for (const std::string &error : inputs.errors)
    problem("", error);
  for (const std::string &warning : inputs.warnings)
    warn("", warning);
  std::vector<std::string> files;
  for (const Input &input : inputs.files)
    files.push_back(input.path);
  session_.folders()->setChecked(files);
  // Programs that are called are found among all files, whichever part of them is checked.
  for (size_t index = 0; index < inputs.files.size(); ++index) {
    Input &input = inputs.files[index];
    if (index % request_.shards != request_.shard)
      continue;
    Job &job = jobs_.emplace_back();
    job.index = jobs_.size() - 1;
    if (input.path != "-" && llvm::sys::fs::file_size(input.path, job.bytes))
      job.bytes = 0; // it is told later why it cannot be read
    job.input = std::move(input);
    if (jobs_.back().input.path == "-")
      readInput(jobs_.back());
  }
}

void Check::openJob(Job &job) {
  if (job.source || !job.outcome.error.empty())
    return;
  auto source = sources_.open(job.input.path, job.input.display);
  if (!source) {
    job.outcome.error = llvm::toString(source.takeError());
    return;
  }
  const std::string why = whyNoProgram((*source)->text());
  if (why.empty()) {
    job.source = *source;
    return;
  }
  // A folder may hold anything under the ending of a program; who names a file means a program.
  job.skipped = !job.input.named && isBinary((*source)->text());
  job.outcome.error = job.input.display + ": not checked: " + why;
}

FileOutcome Check::outcomeOf(const SourceFile &file, Worker &worker) {
  const std::atomic<bool> *cancel = round_ ? &round_->cancel : nullptr;
  return cache_ ? cache_->check(file, cancel, worker.store, worker.opened)
                : checkFile(session_, sources_, file, cancel, nullptr, &worker.store);
}

void Check::checkJob(Job &job, Worker &worker) {
  job.outcome = outcomeOf(*job.source, worker);
  if (job.outcome.postponed)
    return;
  worker.keep(job);
  if (showsPrograms() && job.outcome.error.empty())
    job.view = viewOf(session_, sources_, *job.source);
}

/// Subprograms that call others, when those who call them have been checked.
void Check::checkPostponed() {
  PostponedChecks postponed(jobs_, session_);
  forEachGroup("check", postponed.groups(), [&](Job &job, Worker &worker) {
    worker.store.outer = postponed.outerCallsOf(job);
    checkJob(job, worker);
    postponed.add(job);
  });
}

/// What the worker has kept of other inputs belongs to the input that found it.
void Check::giveBack(Worker &&worker) {
  for (auto &[place, entry] : worker.inCalled)
    jobs_[entry.first].outcome.findings.push_back(std::move(entry.second));
}

void Check::forEachGroup(const char *what, std::vector<std::vector<Job *>> groups, Work work) {
  const size_t count = request_.jobs ? request_.jobs : system::processors();
  std::vector<Worker> workers = workOn(
      std::move(groups), {what, count, !request_.timeTrace.empty()}, [&](Job &job, Worker &worker) {
        if (!isCancelled())
          work(job, worker);
      });
  for (Worker &worker : workers)
    giveBack(std::move(worker));
}

void Check::forEachJob(const char *what, Work work) {
  std::vector<std::vector<Job *>> groups;
  for (Job &job : jobs_)
    groups.push_back({&job});
  forEachGroup(what, std::move(groups), work);
}

/// Replaces the file of the job. That of standard input is standard output, written later.
llvm::Error Check::writeFix(const Job &job) const {
  if (job.input.path == "-")
    return llvm::Error::success();
  if (!request_.inputs.followLinks &&
      leadsOut(job.input.path, llvm::sys::path::parent_path(job.input.path)))
    return failure(job.input.display + " is not written: it is a link out of its folder; "
                                       "--follow-links writes there");
  return replaceFile(job.input.path, job.fixed.text);
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
    if (llvm::Error wrong = writeFix(job)) {
      problem(job.input.display, llvm::toString(std::move(wrong)));
      job.fixed = {};
      continue;
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
  if (compared_.changes)
    llvm::erase_if(all, [&](const CheckedFinding &checked) {
      return !compared_.changes->concern(sources_, checked.finding);
    });
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
  if (compared_.baseline) {
    compared_.baseline->apply(report_.findings);
    report_.baselineUsed = true;
    llvm::StringSet<> files;
    for (const FileReport &file : report_.files)
      files.insert(file.path);
    // Of a part of the findings nobody knows which of the others are gone.
    for (KnownFinding &known :
         compared_.changes ? std::vector<KnownFinding>() : compared_.baseline->absent(files))
      report_.absent.push_back({std::move(known.rule), std::move(known.path),
                                std::move(known.message), known.line, known.fingerprint});
  }
  if (!request_.writeBaseline.empty())
    writeTo(request_.writeBaseline, [&](llvm::raw_ostream &out) {
      writeBaseline(report_.findings, rules_, sources_, out);
    });
}

/// Whether one of the reports shows programs whole.
bool Check::showsPrograms() const {
  const auto shows = [](llvm::StringRef name) {
    return llvm::any_of(reportFormats(), [&](const ReportFormat &format) {
      return format.name == name && format.showsPrograms;
    });
  };
  return llvm::any_of(request_.reports,
                      [&](const ReportTarget &target) { return shows(target.format); });
}

void Check::buildReport() {
  for (const RuleEntry &entry : allRules())
    rules_.push_back(entry.info);
  report_.toolVersion = NCVET_VERSION;
  report_.rules = rules_;
  report_.sources = &sources_;
  report_.colourNames = colourNames();
  report_.folder = folderFromRoot(jobs_);
  if (llvm::SmallString<128> here; !llvm::sys::fs::current_path(here))
    report_.here = llvm::sys::path::convert_to_slash(here);
  for (Job &job : jobs_) {
    if (!job.outcome.error.empty()) {
      job.skipped ? warn(job.input.display, job.outcome.error)
                  : problem(job.input.display, job.outcome.error);
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

void Check::writeTo(const std::string &file, llvm::function_ref<void(llvm::raw_ostream &)> write) {
  if (llvm::Error wrong = writeFile(file, write))
    problem("", llvm::toString(std::move(wrong)));
}

void Check::writeReport(const ReportTarget &target, llvm::raw_ostream &out) const {
  if (request_.statistics && target.format == "text")
    return makeStatisticsWriter()->write(report_, out);
  // Colours are for a terminal, which a file is not.
  const ReportOptions options = {request_.color && target.file == "-", request_.showSource};
  makeReportWriter(target.format, options)->write(report_, out);
}

void Check::writeReports() {
  const bool fixedInput =
      request_.fix && llvm::any_of(jobs_, [](const Job &job) { return job.input.path == "-"; });
  if (fixedInput) { // a filter: standard output is the program
    for (const Job &job : jobs_)
      if (job.input.path == "-" && job.source)
        llvm::outs() << job.source->text();
  }
  for (const ReportTarget &target : request_.reports)
    writeTo(target.file, [&](llvm::raw_ostream &out) { writeReport(target, out); });
  llvm::outs().flush();
}

/// For people, on standard error: who reads a report by a program is left alone.
void Check::writeLastLines() const {
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  const bool forPeople = request_.forPeople();
  if (request_.stats) {
    writeStats(jobs_, report_, cache_ ? cache_->known() : 0, seconds);
  } else if (forPeople && !failed_) { // what went wrong comes first, and alone
    writeCuts(jobs_);
    writeGuess(jobs_);
  }
  if (forPeople)
    writeSummary(request_, jobs_, report_);
}

void Check::noteRead() {
  if (!round_)
    return;
  round_->read = session_.readFiles();
  for (size_t i = 0; i < sources_.size(); ++i)
    if (const std::string &path = sources_.get(FileId(i)).path(); !path.empty())
      round_->read.push_back(path);
}

int Check::run() {
  if (!request_.timeTrace.empty())
    llvm::timeTraceProfilerInitialize(0, "ncvet");
  auto compared = Comparisons::load(request_);
  if (!compared)
    return fail(compared.takeError());
  compared_ = std::move(*compared);
  collect();
  if (request_.fix || request_.diff) {
    forEachJob("fix", [&](Job &job, Worker &) {
      openJob(job);
      if (job.source)
        job.fixed = fixText(session_, *job.source, request_.unsafeFixes);
    });
    writeFixes();
  }
  if (request_.cache)
    cache_ = CheckCache::open(request_.cacheDir, session_, sources_);
  forEachJob("check", [&](Job &job, Worker &worker) {
    openJob(job);
    worker.store.outer.postpones = jobs_.size() > 1;
    if (job.source)
      checkJob(job, worker);
  });
  checkPostponed();
  if (isCancelled()) {
    round_->cancelled = true;
    return exitFailure;
  }
  noteRead();
  if (cache_)
    cache_->prune();
  buildReport();
  writeReports();
  writeLastLines();
  if (!request_.timeTrace.empty()) {
    if (llvm::Error wrong = llvm::timeTraceProfilerWrite(request_.timeTrace, "ncvet"))
      problem("", "cannot write " + request_.timeTrace + ": " + llvm::toString(std::move(wrong)));
    llvm::timeTraceProfilerCleanup();
  }
  const bool told = found_ && !request_.exitZero && request_.writeBaseline.empty();
  return failed_ ? exitFailure : told ? exitFindings : exitClean;
}

} // namespace

int runCheck(CheckRequest request, CheckRound *round) {
  enableCrashGuard();
  return Check(std::move(request), round).run();
}

CheckCommand::CheckCommand() : Command("check", "find what is wrong in part programs") {
  given_.declare(options);
}

llvm::Expected<CheckRequest> CheckCommand::request() const {
  auto request = given_.request(options);
  if (!request)
    return request;
  if (!request->relativeTo.empty())
    if (llvm::Error wrong = showRelativeTo(request->relativeTo, *request))
      return wrong;
  return request;
}

int CheckCommand::run() {
  if (given_.watches())
    return Watch([this] { return request(); },
                 [](CheckRequest request, CheckRound &round) {
                   return runCheck(std::move(request), &round);
                 })
        .run();
  auto once = request();
  return once ? runCheck(std::move(*once)) : fail(once.takeError());
}

} // namespace ncvet::cli
