// A program that is debugged: its files, its setup, and the findings that lie in it.
#pragma once

#include "analyzer/setup/session.h"
#include "formats/finding/finding.h"

#include <memory>

namespace ncvet::dap {

/// A finding of the program's check, where it is reached.
struct ReachedFinding {
  SourceRange range;
  Severity severity = Severity::Warning;
  std::string text; ///< message with the rule's id
};

/// A program with all that it calls, as they are on disk when it is loaded.
class LoadedProgram {
public:
  /// Errors are those of the file, of configurations and of tables.
  static llvm::Expected<std::unique_ptr<LoadedProgram>> load(const std::string &path,
                                                             SessionOptions options);

  Project &project() { return *project_; }
  FileUnit &main() { return *main_; }
  const FileSetup &setup() const { return setup_; }
  /// The file of this path as the program sees it; null when it cannot be read.
  FileUnit *unitOf(const std::string &path);
  /// By file and place. Without those that a comment silences.
  llvm::ArrayRef<ReachedFinding> findings() const { return findings_; }
  /// Indices into `findings` of those that begin in [begin, end) of the file.
  std::pair<size_t, size_t> findingsWithin(FileId file, uint32_t begin, uint32_t end) const;

private:
  LoadedProgram(SessionOptions options) : session_(std::move(options)) {}
  void check();

  Session session_;
  SourceSet sources_;
  FileSetup setup_;
  std::unique_ptr<Project> project_;
  FileUnit *main_ = nullptr;
  std::vector<ReachedFinding> findings_;
};

/// Begin of the first block with content that is on line `line` (from 1) or after it; a block of
/// many lines counts from its first to its last one. None: there is no such block.
std::optional<uint32_t> blockFromLine(const FileUnit &unit, uint32_t line);

/// Absolute, without `.` and `..`: two spellings of a path become one.
std::string plainPath(llvm::StringRef path);

} // namespace ncvet::dap
