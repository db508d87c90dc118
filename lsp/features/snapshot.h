// One version of a document with all that its control makes of it: what every feature looks at.
#pragma once

#include "analyzer/check/checker.h"
#include "analyzer/check/contour_report.h"

namespace ncvet::lsp {

class Names; // lsp/features/names.h

/// One version of a text under its setup: dialect, machine, index, reader, and the project in which
/// other files are found, texts of the editor before those on disk. It never changes, but keeps
/// what it found out: one thread at a time may use it.
class Snapshot {
public:
  /// `path` is the place of the text on disk; it is not read. `memory`, when given, is what
  /// the snapshot of the version before has left, which is not used any more. Errors are those of
  /// configurations and tables.
  static llvm::Expected<std::unique_ptr<Snapshot>>
  make(Session &session, std::shared_ptr<const SourceSet::Overlay> open, llvm::StringRef path,
       SharedText text, CheckMemory *memory = nullptr);

  ~Snapshot();
  Snapshot(const Snapshot &) = delete;
  Snapshot &operator=(const Snapshot &) = delete;

  const SourceFile &source() const { return *source_; }
  llvm::StringRef text() const { return source_->text(); }
  const FileSetup &setup() const { return setup_; }
  const Dialect &dialect() const { return *setup_.dialect; }
  Project &project() { return *project_; }
  FileUnit &unit() { return *unit_; }
  /// A further file as this document's programs see it; null when it cannot be read.
  FileUnit *unitOf(llvm::StringRef path);

  /// Begins of all blocks, ascending, empty ones included; made when first asked for.
  llvm::ArrayRef<uint32_t> blocks();
  /// Reads the block that holds byte `offset`; an empty one after the last.
  void readAt(uint32_t offset, Block &block);
  /// The compensated contours of the program; it is followed when first asked for them.
  llvm::ArrayRef<CompensatedContour> contours();
  /// All names of the text; made when first asked for.
  const Names &names() { return names(*unit_); }
  /// The same of a further file.
  const Names &names(const FileUnit &unit);

private:
  Snapshot(FileSetup setup, std::shared_ptr<const SourceSet::Overlay> open);

  FileSetup setup_;
  SourceSet sources_;
  const SourceFile *source_ = nullptr;
  std::unique_ptr<Project> project_;
  FileUnit *unit_ = nullptr;
  std::vector<uint32_t> blocks_;
  std::optional<std::vector<CompensatedContour>> contours_;
  std::map<FileId, std::unique_ptr<Names>> names_;
};

} // namespace ncvet::lsp
