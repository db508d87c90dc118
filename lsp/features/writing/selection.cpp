// Selected blocks of a document, and the proof that a rewriting of them is one.
#include "lsp/features/writing/selection.h"

#include "analyzer/rule/rule_table.h"

namespace ncvet::lsp {

Selection::Selection(Snapshot &snapshot, uint32_t begin, uint32_t end,
                     std::shared_ptr<const SourceSet::Overlay> open,
                     const std::atomic<bool> *cancel)
    : snapshot_(snapshot), open_(std::move(open)), cancel_(cancel) {
  const llvm::ArrayRef<uint32_t> all = snapshot.blocks();
  auto first = std::upper_bound(all.begin(), all.end(), begin);
  if (first != all.begin())
    --first;
  const auto last = std::lower_bound(first, all.end(), std::max(end, begin + 1));
  begin_ = end_ = first == all.end() ? uint32_t(snapshot.text().size()) : *first;
  for (auto at = first; at != last; ++at) {
    Block block;
    snapshot.unit().reader->read(*at, block);
    end_ = block.next;
    const bool isHead = block.kind == BlockKind::Tape || block.kind == BlockKind::ProgramHeader;
    if (!block.isEmpty() && !isHead)
      blocks_.push_back(std::move(block));
  }
}

std::string Selection::lineOf(uint32_t offset) const {
  return "line " + std::to_string(snapshot_.source().lines().lineOf(offset));
}

SelectionRun Selection::follow(const AxisChanges &changes) {
  return runSelection(snapshot_.project(), snapshot_.unit(), begin_, end_, changes,
                      snapshot_.setup().limits, cancel_);
}

std::string Selection::whyNotWhole(const SelectionRun &run) {
  if (run.isTooLong)
    return "the program is too long to be compared";
  if (run.isLost)
    return "the program does not say how it goes on to its end: what it moves cannot be compared";
  return {};
}

std::string Selection::whyNotKnown(const SelectionRun &run) const {
  if (std::string why = whyNotWhole(run); !why.empty())
    return why;
  for (const Block &block : blocks_)
    if (!run.blocks.count(block.begin))
      return "the program does not come to " + lineOf(block.begin) +
             ": what it moves there is not known";
  return {};
}

const SelectionRun &Selection::run(std::string &refused) {
  if (!run_)
    run_ = follow({});
  refused = whyNotKnown(*run_);
  return *run_;
}

const SelectionRun &Selection::wholeRun(std::string &refused) {
  if (!run_)
    run_ = follow({});
  refused = whyNotWhole(*run_);
  return *run_;
}

/// The run of the text after the edits.
SelectionRun Selection::followAfter(const Rewriting &rewriting) {
  const SourceFile &source = snapshot_.source();
  const std::string text = applyEdits(source.text(), rewriting.edits);
  SourceSet sources(open_);
  const SourceFile &file = sources.add(source.display(), text, source.path());
  const FileSetup &setup = snapshot_.setup();
  Project project(sources, setup.dialect, *setup.machine, setup.config->searchFolders,
                  setup.folders);
  return runSelection(project, project.unit(file), 0, 0, {}, setup.limits, cancel_);
}

void Selection::prove(Rewriting &rewriting, const AxisChanges &changes, double tolerance) {
  if (!rewriting.refused.empty() || rewriting.edits.empty())
    return;
  const bool isChanged = llvm::any_of(changes, [](const AxisChange &one) { return !one.isNone(); });
  std::optional<SelectionRun> changed;
  if (isChanged)
    changed = follow(changes);
  const SelectionRun &due = isChanged ? *changed : run(rewriting.refused);
  rewriting.refused = whyNotKnown(due);
  if (rewriting.refused.empty()) {
    const SelectionRun now = followAfter(rewriting);
    if (now.isLost || now.isTooLong)
      rewriting.refused = "the program would not come to its end";
    else if (const auto at = firstDifference(due, now, tolerance))
      rewriting.refused = lineOf(*at) + " would not move as it should";
  }
  if (!rewriting.refused.empty())
    rewriting.edits.clear();
}

std::set<RuleId> Selection::rulesThatReport(llvm::StringRef text) const {
  const SourceFile &source = snapshot_.source();
  SourceSet sources(open_);
  const SourceFile &file = sources.add(source.display(), text, source.path());
  std::set<RuleId> rules;
  for (const CheckedFinding &checked : checkFile(*session_, sources, file, cancel_).findings)
    if (!checked.finding.suppressed && checked.finding.severity != Severity::Style)
      rules.insert(checked.finding.rule);
  return rules;
}

void Selection::proveSame(Rewriting &rewriting) {
  if (rewriting.refused.empty() && !rewriting.edits.empty()) {
    const SelectionRun &due = wholeRun(rewriting.refused);
    if (rewriting.refused.empty()) {
      const SelectionRun now = followAfter(rewriting);
      if (now.isLost || now.isTooLong)
        rewriting.refused = "the program would not come to its end";
      else if (const auto at = firstDifference(due, now, 1e-6))
        rewriting.refused = lineOf(*at) + " would not move as it should";
      else if (!endAlike(dialect(), due, now))
        rewriting.refused = "the program would end in another state";
    }
  }
  if (rewriting.refused.empty() && !rewriting.edits.empty() && session_) {
    const llvm::StringRef text = snapshot_.text();
    const std::set<RuleId> before = rulesThatReport(text);
    for (const RuleId rule : rulesThatReport(applyEdits(text, rewriting.edits)))
      if (!before.count(rule) && rewriting.refused.empty())
        rewriting.refused = ("there would be a finding of " + allRules()[rule].info.id).str();
  }
  if (!rewriting.refused.empty())
    rewriting.edits.clear();
}

} // namespace ncvet::lsp
