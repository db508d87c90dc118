// Options of `ncvet check`: their declaration, and what they may be.
#include "analyzer/cli/check_options.h"

#include "analyzer/cli/absolute_path.h"
#include "formats/reports/report_formats.h"
#include "formats/text/failure.h"

#include "llvm/Support/Process.h"

namespace ncvet::cli {

namespace {

std::vector<llvm::StringRef> formatNames() {
  std::vector<llvm::StringRef> names;
  for (const ReportFormat &format : reportFormats())
    names.push_back(format.name);
  return names;
}

/// The names of the formats, as long as the process runs.
llvm::StringRef formatHelp() {
  static const std::string help =
      "text (default), " + llvm::join(llvm::makeArrayRef(formatNames()).drop_front(), ", ");
  return help;
}

} // namespace

const ReportTarget *CheckRequest::shown() const {
  const auto target = llvm::find_if(reports, [](const auto &known) { return known.file == "-"; });
  return target == reports.end() ? nullptr : &*target;
}

bool CheckRequest::forPeople() const { return !quiet && (!shown() || shown()->format == "text"); }

void CheckOptions::declare(OptionSet &options) {
  setup_.declare(options);
  options.section("Inputs");
  options.add("--stdin-filename", &stdinFilename_, "what standard input (-) is called")
      .valued("NAME");
  options.add("--follow-links", &inputs_.followLinks,
              "read, and with --fix write, what symbolic links outside of their folder lead to");
  options.add("--exclude", &inputs_.exclude, "leave out what matches when folders are checked")
      .valued("GLOB,..", "globs relative to the current folder")
      .environment();
  options
      .add("--force-exclude", &inputs_.forceExclude,
           "leave out what is excluded even where a path names it, as hooks do")
      .environment();
  options
      .add("--changed-since", &changedSince_,
           "only findings that what changed since a commit of git concerns")
      .valued("COMMIT", "a commit");
  options
      .add("--changed-lines", &changedLines_,
           "only findings that the lines of a patch concern; -: standard input")
      .valued("PATCH", "the file of a unified diff");
  options.add("--shard", &shard_, "check one part of the files: 2/8 is the second of eight")
      .valued("I/N", "I/N, such as 2/8, with I from 1 to N");
  options.section("Rules");
  options.add("--profile", &profile_, "selection of rules: recommended (default), strict, all")
      .valued("NAME")
      .environment();
  options.add("--select", &select_, "only these rules or categories")
      .valued("R,..", "rules or categories")
      .environment();
  options.add("--ignore", &ignore_, "not these rules or categories")
      .valued("R,..", "rules or categories")
      .environment();
  options.add("--severity", &severity_, "report a rule as error, warning or style")
      .valued("R=LEVEL", "RULE=LEVEL");
  declareReports(options);
  options.section("Fixes");
  options.add("--fix", &fix_, "apply the safe fixes to the files, or all")
      .valued("safe|all")
      .among({"safe", "all"})
      .implies("safe");
  options.add("--diff", &diff_, "show what --fix would change, and change nothing");
  options.add("--unsafe-fixes", &unsafeFixes_, "with --fix and --diff: fixes that need a look too");
  declareRun(options);
  options.operands("PATH", paths_, 0, size_t(-1));
}

void CheckOptions::declareRun(OptionSet &options) {
  options.section("Run");
  options.add("--watch", &watch_, "check again, and write the reports again, after each change");
  options.add("--jobs", &jobs_, "files at the same time; default: one for each processor")
      .valued("N", "a number from 1")
      .shortly('j')
      .environment();
  options.add("--memory", &memory_, "cut what would take more memory than so many MiB")
      .valued("MIB", "a number from 1")
      .environment();
  options
      .add("--no-cache", &noCache_,
           "check all files, also those that rest on what they rested on before")
      .environment();
  options.add("--cache-dir", &cacheDir_, "keep what was found here, instead of in the user's cache")
      .valued("DIR", "a folder")
      .environment();
  options.add("--time-trace", &timeTrace_, "where the time went, for chrome://tracing")
      .valued("FILE")
      .hide();
}

void CheckOptions::declareReports(OptionSet &options) {
  options.section("Reports");
  options.add("--format", &format_, formatHelp()).valued("FMT").among(formatNames()).environment();
  options.add("--output", &output_, "write the report to a file instead of standard output")
      .valued("FILE")
      .shortly('o');
  options.add("--report", &reports_, "write a further report; may be repeated; -: standard output")
      .valued("FMT:FILE", "FMT:FILE")
      .wholeValues();
  options.add("--relative-to", &relativeTo_, "show paths as seen from this folder")
      .valued("DIR", "a folder");
  options.add("--show-source", &showSource_, "text: with the program's line (default)");
  options.add("--no-show-source", &hideSource_, "text: without the program's line");
  options.add("--statistics", &statistics_,
              "text: how many findings of each rule, and no findings");
  options.add("--quiet", &quiet_, "findings and errors only: no last line, no remarks")
      .shortly('q')
      .environment();
  options.add("--stats", &stats_,
              "blocks, time, why each dialect was chosen, and the largest tool radius of each "
              "compensated contour");
  options.add("--color", &color_, "auto (default), always, never")
      .valued("WHEN")
      .among({"auto", "always", "never"})
      .environment();
  options.section("Exit code and known findings");
  options
      .add("--fail-on", &failOn_,
           "exit 1 from this level on: error (default), warning, style, never")
      .valued("LEVEL")
      .among({"error", "warning", "style", "never"})
      .environment();
  options.add("--exit-zero", &exitZero_, "exit 0 whatever is found");
  options.add("--baseline", &baseline_, "findings that are known already")
      .valued("FILE")
      .environment();
  options
      .add("--write-baseline", &writeBaseline_,
           "write what is found now as a baseline; -: standard output")
      .valued("FILE");
}

llvm::Error CheckOptions::checkTogether(const OptionSet &options) const {
  const bool fixes = options.isGiven("--fix") || diff_;
  if (unsafeFixes_ && !fixes)
    return failure("--unsafe-fixes needs --fix or --diff");
  if (options.isGiven("--fix") && diff_)
    return failure("--fix and --diff exclude each other: --diff shows what --fix would change");
  const bool standardInput = llvm::is_contained(paths_, "-");
  if (!stdinFilename_.empty() && !standardInput)
    return failure("--stdin-filename needs - among the paths");
  if (showSource_ && hideSource_)
    return failure("--show-source and --no-show-source exclude each other");
  if (exitZero_ && options.isGiven("--fail-on"))
    return failure("--exit-zero and --fail-on exclude each other");
  if (!changedSince_.empty() && !changedLines_.empty())
    return failure("--changed-since and --changed-lines exclude each other");
  if (changedLines_ == "-" && standardInput)
    return failure("--changed-lines - and - among the paths: there is one standard input");
  const bool narrowed = !changedSince_.empty() || !changedLines_.empty() || !shard_.empty();
  if (narrowed && (fixes || !writeBaseline_.empty()))
    return failure("--changed-since, --changed-lines and --shard go with neither --fix, --diff nor "
                   "--write-baseline");
  if (!writeBaseline_.empty() && fixes)
    return failure("--write-baseline and " + llvm::Twine(diff_ ? "--diff" : "--fix") +
                   " exclude each other");
  return checkWatch(fixes || !writeBaseline_.empty());
}

/// What is read once cannot be read again, and what is watched is written by others.
llvm::Error CheckOptions::checkWatch(bool writes) const {
  if (!watch_)
    return llvm::Error::success();
  if (llvm::is_contained(paths_, "-") || changedLines_ == "-")
    return failure("--watch and - exclude each other: standard input is read once");
  if (writes)
    return failure("--watch goes with neither --fix, --diff nor --write-baseline");
  return llvm::Error::success();
}

llvm::Error CheckOptions::readShard(CheckRequest &request) const {
  if (shard_.empty())
    return llvm::Error::success();
  const auto [index, count] = llvm::StringRef(shard_).split('/');
  if (index.getAsInteger(10, request.shard) || count.getAsInteger(10, request.shards) ||
      request.shard == 0 || request.shard > request.shards)
    return failure("--shard wants I/N, such as 2/8, with I from 1 to N, not \"" +
                   llvm::Twine(shard_) + "\"");
  --request.shard;
  return llvm::Error::success();
}

llvm::Error CheckOptions::readRules(RuleSettings &rules) const {
  for (const auto &[given, target] :
       {std::pair(&select_, &rules.select), std::pair(&ignore_, &rules.ignore)})
    for (const std::string &name : *given) {
      if (auto known = rulesNamed(name); !known)
        return known.takeError();
      target->push_back(name);
    }
  for (const std::string &choice : severity_) {
    const auto [name, level] = llvm::StringRef(choice).split('=');
    const std::optional<Severity> severity = parseSeverity(level);
    if (!severity)
      return failure("--severity wants RULE=LEVEL, with error, warning or style as level, not \"" +
                     llvm::Twine(choice) + "\"");
    if (auto known = rulesNamed(name); !known)
      return known.takeError();
    rules.severity.emplace_back(name.str(), *severity);
  }
  return llvm::Error::success();
}

llvm::Error CheckOptions::readReports(const OptionSet &options, CheckRequest &request) const {
  for (const std::string &target : reports_) {
    const auto [format, file] = llvm::StringRef(target).split(':');
    if (!llvm::is_contained(formatNames(), format))
      return failure("--report wants FMT:FILE, with a format first, not \"" + llvm::Twine(target) +
                     "\"" + nearest(format, formatNames()));
    if (file.empty())
      return failure("--report wants FMT:FILE, not \"" + llvm::Twine(target) + "\"");
    if (file == "-" && request.shown())
      return failure("--report: two reports to standard output");
    request.reports.push_back({format.str(), file.str()});
  }
  const bool baselineShown = writeBaseline_ == "-";
  const bool isFilter = options.isGiven("--fix") && llvm::is_contained(paths_, "-");
  if (!output_.empty() && output_ != "-") {
    request.reports.push_back({format_, output_});
  } else if (request.shown()) {
    if (options.isGiven("--format") || baselineShown)
      return failure("--report " + request.shown()->format + ":-: standard output has a " +
                     (baselineShown ? "baseline" : "report") + " already");
  } else if (baselineShown && options.isGiven("--format")) {
    return failure("--write-baseline -: standard output has a report already");
  } else if (!isFilter && !diff_ && (writeBaseline_.empty() || options.isGiven("--format"))) {
    // What is being written down as known need not be told.
    request.reports.push_back({format_, "-"});
  }
  return llvm::Error::success();
}

void CheckOptions::readFixes(const OptionSet &options, CheckRequest &request) const {
  request.diff = diff_;
  request.fix = options.isGiven("--fix");
  request.unsafeFixes = unsafeFixes_ || fix_ == "all";
}

llvm::Expected<CheckRequest> CheckOptions::request(const OptionSet &options) const {
  CheckRequest request;
  if (llvm::Error wrong = checkTogether(options))
    return wrong;
  request.session.profile = profile_;
  if (llvm::Error wrong = readRules(request.session.rules))
    return wrong;
  if (llvm::Error wrong = readReports(options, request))
    return wrong;
  if (!profile_.empty())
    if (auto layers = loadProfile(profile_); !layers)
      return layers.takeError();
  if (llvm::Error wrong = setup_.apply(request.session))
    return wrong;
  if (!failOn_.empty())
    request.failOn = llvm::cantFail(parseFailOn(failOn_));
  readFixes(options, request);
  request.color =
      color_ == "always" || (color_ == "auto" && !llvm::sys::Process::GetEnv("NO_COLOR") &&
                             llvm::sys::Process::StandardOutHasColors());
  // On Windows they would be set in the console alone, and be lost in a pipe.
  llvm::sys::Process::UseANSIEscapeCodes(request.color);
  request.paths = paths_.empty() ? std::vector<std::string>{"."} : paths_;
  request.baseline = baseline_;
  request.writeBaseline = writeBaseline_;
  request.stdinFilename = stdinFilename_;
  request.timeTrace = timeTrace_;
  request.jobs = jobs_;
  request.session.limits.memory = uint64_t(memory_) << 20;
  request.quiet = quiet_;
  request.exitZero = exitZero_;
  request.cache = !noCache_ && timeTrace_.empty(); // a trace is of what takes time
  if (!cacheDir_.empty())
    request.cacheDir = absolutePath(cacheDir_);
  request.statistics = statistics_;
  request.showSource = !hideSource_;
  request.changedSince = changedSince_;
  request.changedLines = changedLines_;
  if (llvm::Error wrong = readShard(request))
    return wrong;
  request.inputs = inputs_;
  request.stats = request.session.contours = stats_;
  request.relativeTo = relativeTo_;
  for (const std::string *file : {&baseline_, &changedLines_})
    if (!file->empty())
      request.watched.push_back(absolutePath(*file));
  if (request.session.machine)
    request.watched.push_back(absolutePath(request.session.machine->name));
  return request;
}

} // namespace ncvet::cli
