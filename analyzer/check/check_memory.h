// What checks of one file keep for the next one.
#pragma once

#include "analyzer/program/file_scan.h"
#include "analyzer/program/program_index.h"
#include "analyzer/reuse/taken_runs.h"
#include "formats/dialect/machine.h"
#include "formats/text/text_change.h"

#include <memory>
#include <optional>
#include <string>

namespace ncvet {

class ProgramFolders;
struct RuleSelection;
class StraightRuns;
struct FileSetup;

/// What checks of one file keep for the next one, so that it need only follow what has changed.
/// Belongs to one thread.
class CheckMemory {
public:
  CheckMemory();
  CheckMemory(CheckMemory &&) noexcept;
  CheckMemory &operator=(CheckMemory &&) noexcept;
  ~CheckMemory();

  /// What is known of `text`, that of `file`, under this setup: moved from the text that was
  /// checked last.
  FileScan *scanFor(const FileSetup &setup, const SourceFile &file, const SharedText &text);
  /// The runs for the same text, of which this is the index.
  StraightRuns *runsFor(const FileIndex &index);
  /// A check has followed all of the text.
  void setChecked() { checked_ = true; }
  bool isChecked() const { return checked_; }
  /// Forgets everything, after a crash.
  void abandon();
  /// Blocks that the next check need not follow when nothing changes.
  uint64_t blocks() const;
  /// What was taken over since the last call.
  TakenRuns takeTaken();

private:
  FileScan scan_;
  std::unique_ptr<StraightRuns> runs_; ///< a pointer: the editor's features need not see states
  std::shared_ptr<const std::string> text_;
  bool checked_ = false;
  std::optional<TextChanges> changes_; ///< that led to it; none: it is another text
  std::shared_ptr<const Dialect> dialect_;
  std::shared_ptr<const MachineProfile> machine_;
  std::shared_ptr<const RuleSelection> rules_;
  std::shared_ptr<ProgramFolders> folders_;
  FileId file_ = 0;
  std::string programs_; ///< which programs the text held
};

/// The text of the file that is checked, and what earlier checks of it have left.
struct Recheck {
  SharedText text;
  CheckMemory &memory;
};

} // namespace ncvet
