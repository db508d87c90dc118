// Selected blocks of a document, and the proof that a rewriting of them is one.
#pragma once

#include "formats/text/edit.h"
#include "lsp/features/snapshot.h"
#include "lsp/features/writing/selection_run.h"

#include <set>

namespace ncvet::lsp {

/// A program that a rewriting writes into a file of its own.
struct NewFile {
  std::string path, text;
};

/// A change of selected blocks that a user may choose.
struct Rewriting {
  std::string title;
  std::vector<TextEdit> edits; ///< in the order of the text
  std::optional<NewFile> file; ///< made beside that of the text
  std::string refused;         ///< not empty: why there are none, for the user
};

/// The whole blocks that a selection touches.
class Selection {
public:
  /// `begin` and `end` are bytes; an end at the start of a line does not touch it. `open`: texts of
  /// the editor, in which called programs are looked for first.
  Selection(Snapshot &snapshot, uint32_t begin, uint32_t end,
            std::shared_ptr<const SourceSet::Overlay> open, const std::atomic<bool> *cancel);
  /// With it, `proveSame` looks at findings too.
  void checkBy(Session &session) { session_ = &session; }

  Snapshot &snapshot() const { return snapshot_; }
  const Dialect &dialect() const { return snapshot_.dialect(); }
  /// Whether the editor has a text of this path.
  bool isOpen(const std::string &path) const { return open_ && open_->count(path); }
  /// With content, in the order of the text.
  llvm::ArrayRef<Block> blocks() const { return blocks_; }
  uint32_t begin() const { return begin_; }
  /// After the last block, with its line end.
  uint32_t end() const { return end_; }
  /// Number of the line, for messages.
  std::string lineOf(uint32_t offset) const;
  /// What the blocks do; `refused` says why nobody knows.
  const SelectionRun &run(std::string &refused);

  /// The same where not every selected block need be executed.
  const SelectionRun &wholeRun(std::string &refused);

  /// Refuses a rewriting after which the machine does something else: other than before, or than
  /// `changes` say of the selected blocks.
  void prove(Rewriting &rewriting, const AxisChanges &changes = {}, double tolerance = 1e-6);
  /// Refuses one after which the machine does not do exactly the same, ends in another state, or a
  /// rule reports an error or a warning that reported none before.
  void proveSame(Rewriting &rewriting);

private:
  SelectionRun follow(const AxisChanges &changes);
  SelectionRun followAfter(const Rewriting &rewriting);
  static std::string whyNotWhole(const SelectionRun &run);
  std::string whyNotKnown(const SelectionRun &run) const;
  /// The text after the edits, among the files as they are then.
  struct After;
  std::set<RuleId> rulesThatReport(const Rewriting *rewriting) const;
  std::string whyNotClean(const Rewriting &rewriting) const;

  Snapshot &snapshot_;
  const std::shared_ptr<const SourceSet::Overlay> open_;
  const std::atomic<bool> *const cancel_;
  Session *session_ = nullptr;
  uint32_t begin_ = 0, end_ = 0;
  std::vector<Block> blocks_;
  std::optional<SelectionRun> run_;
};

} // namespace ncvet::lsp
