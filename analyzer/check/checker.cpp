// Checker: setup, analysis, suppression and naming of findings for one file.
#include "analyzer/check/checker.h"

#include "analyzer/check/contour_report.h"
#include "analyzer/check/due_where.h"
#include "analyzer/check/fold_repeats.h"
#include "analyzer/check/foreign_text.h"
#include "analyzer/flow/analyze.h"
#include "analyzer/flow/states_at_block.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule_settings.h"
#include "analyzer/rule/rule_table.h"
#include "formats/finding/fingerprint.h"
#include "formats/text/crash_guard.h"
#include "formats/text/formatted.h"

#include <cmath>
#include <set>

namespace ncvet {

namespace {

/// The rule whose findings come from the step that applies suppressions.
constexpr llvm::StringLiteral unusedSuppressionRule = "style-unused-suppression";

/// Names the findings of one analysis; blocks that hold several are read once.
class Namer {
public:
  explicit Namer(Project &project) : project_(project) {}

  void name(CheckedFinding &checked) {
    const SourceRange at = checked.finding.range;
    FileUnit &unit = project_.unit(project_.sources().get(at.file));
    if (at.file != file_ || at.begin < block_.begin || at.begin >= block_.next)
      readBlock(unit, at.begin);
    file_ = at.file;
    if (const ProgramInfo &program = unit.index.programAt(at.begin); program.number >= 0)
      checked.program = ("O" + llvm::Twine(program.number)).str();
    checked.blockText = text_;
  }

private:
  void readBlock(FileUnit &unit, uint32_t offset) {
    readBlockAt(unit.source, *unit.reader, offset, block_);
    llvm::SmallVector<SourceRange, 4> leftOut;
    if (block_.number >= 0)
      leftOut.push_back({unit.source.id(), block_.numberBegin, block_.numberEnd});
    for (const Comment &comment : block_.comments)
      leftOut.push_back({unit.source.id(), comment.begin, comment.end});
    llvm::sort(leftOut,
               [](const SourceRange &a, const SourceRange &b) { return a.begin < b.begin; });
    text_ = fingerprintText(unit.source, {unit.source.id(), block_.begin, block_.end}, leftOut);
  }

  Project &project_;
  FileId file_ = FileId(-1);
  Block block_;
  std::string text_;
};

/// Marks what comments suppress, and reports comments of `unit` that suppress nothing.
class SuppressionStep {
public:
  SuppressionStep(Project &project, FileUnit &unit, const RuleSelection &rules)
      : project_(project), unit_(unit), rules_(rules) {}

  void run(std::vector<Finding> &findings, FileOutcome &outcome) {
    std::set<FileId> files{unit_.source.id()};
    for (const Finding &finding : findings)
      files.insert(finding.range.file);
    for (const FileId file : files) {
      FileUnit &at = project_.unit(project_.sources().get(file));
      std::vector<Suppression> suppressions = at.index.suppressions(rulesCalled).vec();
      applySuppressions(suppressions, at.source, findings);
      if (file == unit_.source.id())
        own_ = std::move(suppressions);
      else
        noteUsed(at.source, suppressions, outcome);
    }
    reportUnused(findings);
  }

private:
  static void noteUsed(const SourceFile &source, llvm::ArrayRef<Suppression> suppressions,
                       FileOutcome &outcome) {
    for (const Suppression &suppression : suppressions)
      for (const SuppressedName &name : suppression.names)
        if (name.used)
          outcome.usedSuppressions.emplace_back(source.display(), name.range.begin);
  }

  void reportUnused(std::vector<Finding> &findings) {
    const llvm::ArrayRef<RuleEntry> entries = allRules();
    const auto *entry = llvm::find_if(
        entries, [](const RuleEntry &known) { return known.info.id == unusedSuppressionRule; });
    const auto rule = RuleId(entry - entries.begin());
    if (entry == entries.end() || !rules_.enabled[rule])
      return;
    Finding finding;
    finding.rule = rule;
    finding.severity = severityOf(rule, entry->info);
    finding.message = "the comment suppresses nothing: no such finding here";
    for (const Suppression &suppression : own_)
      for (const SuppressedName &name : suppression.names)
        if (!name.used && !name.dead && suppression.verb != SuppressionVerb::On && hasRun(name)) {
          finding.range = name.range;
          findings.push_back(finding);
        }
  }

  Severity severityOf(RuleId rule, const RuleInfo &info) const {
    if (rules_.severity[rule])
      return *rules_.severity[rule];
    const auto table = unit_.dialect->rules.find(info.id);
    if (table != unit_.dialect->rules.end() && table->second.severity)
      return *table->second.severity;
    return info.severity;
  }

  /// A rule that is off may be what the comment is for.
  bool hasRun(const SuppressedName &name) const {
    return llvm::any_of(name.rules, [&](RuleId rule) { return rules_.enabled[rule]; });
  }

  Project &project_;
  FileUnit &unit_;
  const RuleSelection &rules_;
  std::vector<Suppression> own_;
};

/// "12: contour on the left, 8 elements, safe up to R6.00"
std::vector<std::string> contourLines(llvm::ArrayRef<CompensatedContour> contours,
                                      const FileUnit &main) {
  std::vector<std::string> lines;
  for (const CompensatedContour &contour : contours) {
    const SourceFile &file = contour.unit->source;
    std::string line = std::to_string(file.lines().lineOf(contour.begin)) + ":";
    if (contour.unit != &main)
      line += " (" + file.display() + ")";
    line += formatted(" contour on the {0}, {1} {2}{3}, ", contour.onLeft ? "left" : "right",
                      contour.elements, contour.elements == 1 ? "element" : "elements",
                      contour.whole ? "" : " known");
    // What is rounded up would not fit.
    line += contour.largest
                ? formatted("safe up to R{0:f2}", std::floor(*contour.largest * 100) / 100)
                : "safe for any tool";
    lines.push_back(std::move(line));
  }
  return lines;
}

const std::string &nameOf(const SourceFile &file) {
  return file.path().empty() ? file.display() : file.path();
}

/// One file under its setup, followed and made into findings.
void checkUnder(const FileSetup &setup, Session &session, Project &project, FileUnit &unit,
                const std::atomic<bool> *cancel, Recheck *again, const OuterCalls *outer,
                FileOutcome &outcome) {
  const SourceFile &file = unit.source;
  AnalysisResult result = analyze(project, unit, *setup.rules, setup.limits, cancel,
                                  again ? again->memory.runsFor(unit.index) : nullptr, outer);
  outcome.postponed = result.postponed;
  outcome.asksOuter = result.asksOuter;
  outcome.restsOnOthers = result.restsOnOthers;
  outcome.work = result.work;
  outcome.followed = std::move(result.followed);
  if (result.postponed)
    return;
  if (again && result.complete)
    again->memory.setChecked();
  outcome.blocks = result.blocks;
  outcome.complete = result.complete;
  outcome.cuts = std::move(result.cuts);
  const auto otherControl = [&] { return session.otherControl(setup, nameOf(file), file.text()); };
  dropUndue(project, unit, result.findings);
  foldForeignText(project, unit, {result.blocks, setup.detected, setup.sure, otherControl},
                  result.findings);
  SuppressionStep(project, unit, *setup.rules).run(result.findings, outcome);
  if (session.options().contours)
    outcome.contours = contourLines(compensatedContours(project, unit, setup.limits), unit);
  foldRepeats(result.findings);
  Namer namer(project);
  outcome.findings.reserve(result.findings.size());
  for (Finding &finding : result.findings) {
    outcome.findings.push_back({std::move(finding), {}, {}, outcome.failOn});
    namer.name(outcome.findings.back());
  }
}

} // namespace

FileOutcome checkFile(Session &session, SourceSet &sources, const SourceFile &file,
                      const std::atomic<bool> *cancel, Recheck *again, CheckStore *store) {
  auto outcome = std::make_unique<FileOutcome>();
  auto setup = session.setup(nameOf(file), file.text());
  if (!setup) {
    outcome->error = llvm::toString(setup.takeError());
    return std::move(*outcome);
  }
  outcome->dialect = setup->dialect->id;
  outcome->dialectTitle = setup->dialect->title;
  outcome->reason = setup->reason;
  outcome->guessed = setup->detected;
  outcome->sure = setup->sure;
  if (setup->config->failOn)
    outcome->failOn = *setup->config->failOn;
  // Setups are shared, and made under a lock: only what belongs to this file alone may crash.
  const auto crash = runGuarded([&] {
    if (store)
      return store->projectFor(*setup, sources).withMain(file, [&](FileUnit &unit) {
        checkUnder(*setup, session, *unit.project, unit, cancel, nullptr, &store->outer, *outcome);
      });
    Project project(sources, setup->dialect, *setup->machine, setup->config->searchFolders,
                    setup->folders);
    FileUnit &unit =
        project.unit(file, again ? again->memory.scanFor(*setup, file, again->text) : nullptr);
    checkUnder(*setup, session, project, unit, cancel, again, nullptr, *outcome);
  });
  if (!crash)
    return std::move(*outcome);
  static_cast<void>(outcome.release());
  if (store)
    store->abandon();
  if (again)
    again->memory.abandon();
  FileOutcome failed;
  failed.error = file.display() + ": ncvet failed on this file, which is not checked: " + *crash;
  return failed;
}

StatesAt statesInCheck(Session &session, SourceSet &sources, const SourceFile &file,
                       uint32_t offset, const std::atomic<bool> *cancel, Recheck &again) {
  auto setup = session.setup(nameOf(file), file.text());
  if (!setup) {
    llvm::consumeError(setup.takeError()); // the check reports it
    return {};
  }
  auto states = std::make_unique<StatesAt>();
  const auto crash = runGuarded([&] {
    Project project(sources, setup->dialect, *setup->machine, setup->config->searchFolders,
                    setup->folders);
    FileUnit &unit = project.unit(file, again.memory.scanFor(*setup, file, again.text));
    StraightRuns &runs = *again.memory.runsFor(unit.index);
    *states = again.memory.isChecked()
                  ? statesAfterCheck(project, unit, offset, setup->limits, cancel, runs)
                  : statesAt(project, unit, offset, *setup->rules, setup->limits, cancel, runs);
  });
  if (!crash)
    return std::move(*states);
  static_cast<void>(states.release());
  again.memory.abandon(); // the check reports it
  return {};
}

void prepareChecks(Session &session, SourceSet &sources, const SourceFile &file, Recheck &first) {
  auto setup = session.setup(nameOf(file), file.text());
  if (!setup)
    return llvm::consumeError(setup.takeError()); // the check has told
  session.otherControl(*setup, nameOf(file), file.text());
  Project project(sources, setup->dialect, *setup->machine, setup->config->searchFolders,
                  setup->folders);
  FileUnit &unit = project.unit(file, first.memory.scanFor(*setup, file, first.text));
  for (const ProgramInfo &program : unit.index.programs())
    unit.index.definitions(program);
}

} // namespace ncvet
