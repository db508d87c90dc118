// Source set: the files of one run, owned and numbered.
#pragma once

#include "formats/text/source.h"

#include <deque>
#include <map>
#include <mutex>

namespace ncvet {

/// Owns the files of one run; a `FileId` is the index of its file. Files stay where they are as
/// long as the set lives. Several threads may add and look up; a `SourceFile` itself belongs to
/// one thread at a time. Ids are given out in the order of arrival: they must not reach output.
class SourceSet {
public:
  /// Texts that replace the files of these paths: what an editor has not saved yet.
  using Overlay = std::map<std::string, std::shared_ptr<const std::string>>;

  SourceSet() = default;
  explicit SourceSet(std::shared_ptr<const Overlay> overlay) : overlay_(std::move(overlay)) {}

  /// Adds the file at `path`; errors as those of `SourceFile::open`, and nothing is added then.
  llvm::Expected<const SourceFile *> open(llvm::StringRef path, llvm::StringRef display);
  llvm::Expected<const SourceFile *> open(llvm::StringRef path) { return open(path, path); }
  /// Adds text that is already in memory; see `SourceFile::fromText`.
  const SourceFile &add(llvm::StringRef display, llvm::StringRef text, llvm::StringRef path = {});
  /// Adds text that others hold as well; see `SourceFile::fromShared`.
  const SourceFile &add(llvm::StringRef display, SharedText text, llvm::StringRef path);
  /// The file of an id that this set gave out.
  const SourceFile &get(FileId id) const;
  size_t size() const;

private:
  std::shared_ptr<const Overlay> overlay_;
  mutable std::mutex mutex_;
  std::deque<std::unique_ptr<SourceFile>> files_;
};

} // namespace ncvet
