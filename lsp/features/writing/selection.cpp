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

/// A new file lies in no folder yet: it is laid over those of the disk as a text of the editor, and
/// its name is found as that of a file which is checked together with the text.
struct Selection::After {
  After(const Selection &selection, const Rewriting *rewriting)
      : text(rewriting ? applyEdits(selection.snapshot_.text(), rewriting->edits)
                       : selection.snapshot_.text().str()),
        folders(selection.snapshot_.setup().folders), open(selection.open_) {
    const NewFile *const made = rewriting && rewriting->file ? &*rewriting->file : nullptr;
    if (!made)
      return;
    folders = std::make_shared<ProgramFolders>();
    folders->setChecked({made->path});
    auto texts = open ? *open : SourceSet::Overlay();
    texts[selection.snapshot_.source().path()] = std::make_shared<const std::string>(text);
    texts[made->path] = std::make_shared<const std::string>(made->text);
    open = std::make_shared<const SourceSet::Overlay>(std::move(texts));
  }

  std::string text;
  std::shared_ptr<ProgramFolders> folders;
  std::shared_ptr<const SourceSet::Overlay> open;
};

/// The run of the text after the edits.
SelectionRun Selection::followAfter(const Rewriting &rewriting) {
  const SourceFile &source = snapshot_.source();
  const After after(*this, &rewriting);
  SourceSet sources(after.open);
  const SourceFile &file = sources.add(source.display(), after.text, source.path());
  const FileSetup &setup = snapshot_.setup();
  Project project(sources, setup.dialect, *setup.machine, setup.config->searchFolders,
                  after.folders);
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

/// Null: those of the text as it is.
std::set<RuleId> Selection::rulesThatReport(const Rewriting *rewriting) const {
  const SourceFile &source = snapshot_.source();
  const After after(*this, rewriting);
  SourceSet sources(after.open);
  std::set<RuleId> rules;
  const auto check = [&](Session &session, const SourceFile &file) {
    for (const CheckedFinding &checked : checkFile(session, sources, file, cancel_).findings)
      if (!checked.finding.suppressed && checked.finding.severity != Severity::Style)
        rules.insert(checked.finding.rule);
  };
  const SourceFile &file = sources.add(source.display(), after.text, source.path());
  if (!rewriting || !rewriting->file) {
    check(*session_, file);
    return rules;
  }
  Session session(session_->options());
  const std::string &made = rewriting->file->path;
  session.folders()->setChecked({made});
  check(session, file);
  check(session, sources.add(made, rewriting->file->text, made));
  return rules;
}

/// Which rule reports what none reported before.
std::string Selection::whyNotClean(const Rewriting &rewriting) const {
  const std::set<RuleId> before = rulesThatReport(nullptr);
  for (const RuleId rule : rulesThatReport(&rewriting))
    if (!before.count(rule))
      return ("there would be a finding of " + allRules()[rule].info.id).str();
  return {};
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
  if (rewriting.refused.empty() && !rewriting.edits.empty() && session_)
    rewriting.refused = whyNotClean(rewriting);
  if (!rewriting.refused.empty()) {
    rewriting.edits.clear();
    rewriting.file.reset();
  }
}

} // namespace ncvet::lsp
