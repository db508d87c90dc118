// Options of `ncvet check`: their declaration, and what they may be.
#include "analyzer/cli/check_options.h"

#include "formats/dialect/json_reader.h"
#include "formats/reports/report_formats.h"
#include "formats/text/failure.h"

#include "llvm/Support/Process.h"

namespace ncvet::cli {

namespace cl = llvm::cl;

namespace {

llvm::Error unknownFormat(llvm::StringRef given) {
  std::vector<llvm::StringRef> known;
  for (const ReportFormat &format : reportFormats())
    known.push_back(format.name);
  return failure("unknown format \"" + given + "\"" + suggest(given, known));
}

bool isFormat(llvm::StringRef name) {
  return llvm::any_of(reportFormats(),
                      [&](const ReportFormat &format) { return format.name == name; });
}

} // namespace

CheckOptions::CheckOptions()
    : command("check", "find what is wrong in part programs"), category_("Options of ncvet check"),
      paths_(cl::Positional, cl::desc("[PATH...]"), cl::ZeroOrMore, cl::sub(command),
             cl::cat(category_)),
      dialect_("dialect", cl::value_desc("ID"), cl::init("auto"),
               cl::desc("The control, or a table's file; auto: found out"), cl::sub(command),
               cl::cat(category_)),
      machine_("machine", cl::value_desc("FILE"), cl::desc("Profile of the machine"),
               cl::sub(command), cl::cat(category_)),
      config_("config", cl::value_desc("FILE"),
              cl::desc("Configuration instead of the nearest .ncvet.json"), cl::sub(command),
              cl::cat(category_)),
      profile_("profile", cl::value_desc("NAME"),
               cl::desc("Selection of rules: recommended (default), strict, all"), cl::sub(command),
               cl::cat(category_)),
      select_("select", cl::value_desc("R,.."), cl::CommaSeparated,
              cl::desc("Only these rules or categories"), cl::sub(command), cl::cat(category_)),
      ignore_("ignore", cl::value_desc("R,.."), cl::CommaSeparated,
              cl::desc("Not these rules or categories"), cl::sub(command), cl::cat(category_)),
      severity_("severity", cl::value_desc("R=LEVEL"), cl::CommaSeparated,
                cl::desc("Report a rule as error, warning or style"), cl::sub(command),
                cl::cat(category_)),
      format_("format", cl::value_desc("FMT"), cl::init("text"),
              cl::desc("text (default), json, sarif, gcc, checkstyle, html"), cl::sub(command),
              cl::cat(category_)),
      report_("report", cl::value_desc("FMT:FILE"), cl::desc("Write a further report"),
              cl::sub(command), cl::cat(category_)),
      failOn_("fail-on", cl::value_desc("LEVEL"),
              cl::desc("Exit 1 from this level on: error (default), warning, style, never"),
              cl::sub(command), cl::cat(category_)),
      baseline_("baseline", cl::value_desc("FILE"), cl::desc("Findings that are known already"),
                cl::sub(command), cl::cat(category_)),
      writeBaseline_("write-baseline", cl::value_desc("FILE"),
                     cl::desc("Write what is found now as a baseline"), cl::sub(command),
                     cl::cat(category_)),
      jobs_("jobs", cl::value_desc("N"), cl::init(0), cl::desc("Files at the same time"),
            cl::sub(command), cl::cat(category_)),
      stats_("stats",
             cl::desc("Blocks, time, why each dialect was chosen, and the largest tool radius of "
                      "each compensated contour"),
             cl::sub(command), cl::cat(category_)),
      fix_("fix", cl::value_desc("safe|all"), cl::ValueOptional, cl::init("none"),
           cl::desc("Apply the safe fixes to the files, or all"), cl::sub(command),
           cl::cat(category_)),
      diff_("diff", cl::desc("Show what --fix would change"), cl::sub(command), cl::cat(category_)),
      unsafeFixes_("unsafe-fixes", cl::desc("With --fix and --diff: fixes that need a look too"),
                   cl::sub(command), cl::cat(category_)),
      stdinFilename_("stdin-filename", cl::value_desc("NAME"),
                     cl::desc("What standard input (-) is called"), cl::sub(command),
                     cl::cat(category_)),
      color_("color", cl::value_desc("WHEN"), cl::init("auto"), cl::desc("auto, always, never"),
             cl::sub(command), cl::cat(category_)),
      timeTrace_("time-trace", cl::value_desc("FILE"),
                 cl::desc("Write where the time went, for chrome://tracing"), cl::sub(command),
                 cl::cat(category_), cl::Hidden) {}

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
      return failure("--severity " + llvm::Twine(choice) +
                     ": RULE=LEVEL is expected, with a level of error, warning, style");
    if (auto known = rulesNamed(name); !known)
      return known.takeError();
    rules.severity.emplace_back(name.str(), *severity);
  }
  return llvm::Error::success();
}

llvm::Error CheckOptions::readReports(CheckRequest &request) const {
  request.format = format_;
  if (!isFormat(format_))
    return unknownFormat(format_);
  for (const std::string &target : report_) {
    const auto [format, file] = llvm::StringRef(target).split(':');
    if (file.empty())
      return failure("--report " + llvm::Twine(target) + ": FMT:FILE is expected");
    if (!isFormat(format))
      return unknownFormat(format);
    request.reports.push_back({format.str(), file.str()});
  }
  return llvm::Error::success();
}

llvm::Expected<CheckRequest> CheckOptions::request() const {
  CheckRequest request;
  request.session.dialect = dialect_;
  request.session.configFile = config_;
  request.session.profile = profile_;
  if (llvm::Error wrong = readRules(request.session.rules))
    return wrong;
  if (llvm::Error wrong = readReports(request))
    return wrong;
  if (!profile_.empty())
    if (auto layers = loadProfile(profile_); !layers)
      return layers.takeError();
  if (!machine_.empty()) {
    auto machine = readMachine(machine_);
    if (!machine)
      return machine.takeError();
    request.session.machine = std::move(*machine);
  }
  if (!failOn_.empty()) {
    auto level = parseFailOn(failOn_);
    if (!level)
      return failure("--fail-on: " + llvm::toString(level.takeError()));
    request.failOn = *level;
  }
  if (fix_ != "none" && fix_ != "" && fix_ != "safe" && fix_ != "all")
    return failure("--fix=" + llvm::Twine(fix_) + ": safe or all is expected");
  request.diff = diff_;
  request.fix = fix_ != "none" && !diff_;
  request.unsafeFixes = unsafeFixes_ || fix_ == "all";
  if (color_ != "auto" && color_ != "always" && color_ != "never")
    return failure("--color " + llvm::Twine(color_) + ": auto, always or never is expected");
  request.color =
      color_ == "always" || (color_ == "auto" && !llvm::sys::Process::GetEnv("NO_COLOR") &&
                             llvm::sys::Process::StandardOutHasColors());
  request.paths.assign(paths_.begin(), paths_.end());
  if (request.paths.empty())
    request.paths = {"."};
  request.baseline = baseline_;
  request.writeBaseline = writeBaseline_;
  request.stdinFilename = stdinFilename_;
  request.timeTrace = timeTrace_;
  request.jobs = jobs_;
  request.stats = request.session.contours = stats_;
  return request;
}

} // namespace ncvet::cli
