// What the check of a file looks up outside of it.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <map>
#include <string>
#include <tuple>

namespace ncvet {

class SourceFile;

/// A question about the file system whose answer findings may rest on.
struct Lookup {
  enum class Kind : uint8_t {
    Text,           ///< what the file `path` holds
    Programs,       ///< which programs are in the folder `path`
    Files,          ///< which files that end in `names` are in the folder `path`; what they hold
    Folders,        ///< which folders are in the folder `path`
    Stores,         ///< stores of the backup round the folder `path`; `names`: those of the control
    Checked,        ///< files of the name `path` among those that are checked together
    CheckedFolders, ///< folders of those that are checked together
  };
  static constexpr unsigned kinds = unsigned(Kind::CheckedFolders) + 1;

  Kind kind = Kind::Text;
  std::string path, names; ///< names of stores: one a line

  bool operator<(const Lookup &other) const {
    return std::tie(kind, path, names) < std::tie(other.kind, other.path, other.names);
  }
};

/// Gives the answer of a lookup as a hash.
class LookupSource {
public:
  virtual ~LookupSource() = default;
  virtual uint64_t of(const Lookup &lookup) = 0;
};

/// Lookups of one thread, noted as long as the object lives: those of the check of one file.
class LookupRecord {
public:
  explicit LookupRecord(LookupSource &answers);
  ~LookupRecord();
  LookupRecord(const LookupRecord &) = delete;

  /// The record of this thread; null: nothing is recorded.
  static LookupRecord *current();
  void note(Lookup lookup);
  /// The file was read, and holds this.
  void noteText(const SourceFile &file);
  const std::map<Lookup, uint64_t> &answers() const { return noted_; }

private:
  LookupSource &answers_;
  std::map<Lookup, uint64_t> noted_;
  LookupRecord *const outer_;
};

/// Notes a lookup where one is recorded.
inline void noteLookup(Lookup::Kind kind, llvm::StringRef path, llvm::StringRef names = {}) {
  if (LookupRecord *const record = LookupRecord::current())
    record->note({kind, path.str(), names.str()});
}

} // namespace ncvet
