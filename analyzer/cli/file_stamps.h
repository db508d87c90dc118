// What the result of a check rests on, as it is on disk: which files there are, and their stamps.
#pragma once

#include "analyzer/cli/check_options.h"

#include "llvm/Support/Chrono.h"

#include <set>

namespace ncvet::cli {

/// Which text of a file it is, as far as that can be told without reading it.
struct FileStamp {
  enum class Kind : uint8_t { Missing, Name, File };
  Kind kind = Kind::Missing; ///< `Name`: it is there, and what it holds does not matter
  uint64_t device = 0, number = 0, size = 0;
  llvm::sys::TimePoint<> written;

  bool operator==(const FileStamp &other) const;
};

/// The stamps of all files that a request means, and of those that its last check has read.
class FileStamps {
public:
  /// As they are now. What ncvet itself writes, the reports, is not among them.
  FileStamps(const CheckRequest &request, llvm::ArrayRef<std::string> read);

  /// Takes over what `later` knows of the files that only the check has told of. One that was
  /// written after `begin`, when the check began, may have changed after it was read: it counts as
  /// changed.
  void addRead(const FileStamps &later, llvm::sys::TimePoint<> begin);
  /// A file that is another one now, or is there in one of the two only; empty: none is.
  std::string difference(const FileStamps &other) const;
  /// The folders of all these files.
  const std::set<std::string> &folders() const { return folders_; }
  /// Programs that the request means.
  size_t programs() const { return programs_; }

private:
  using Stamps = std::map<std::string, FileStamp>;

  void addWritten(const CheckRequest &request);
  void addFolder(llvm::StringRef folder);
  void addFile(Stamps &stamps, const std::string &file);

  std::set<std::pair<uint64_t, uint64_t>> written_; ///< by ncvet
  std::set<std::string> writtenPaths_;              ///< … which may not be there yet
  Stamps meant_, read_;
  std::set<std::string> folders_, listed_; ///< of all files; those whose names count
  size_t programs_ = 0;
};

} // namespace ncvet::cli
