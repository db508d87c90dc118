// The files of one analysis: the current program and those that it calls from elsewhere.
#pragma once

#include "analyzer/program/folder_calls.h"
#include "analyzer/program/program_index.h"
#include "formats/dialect/machine.h"
#include "formats/readers/select/make_reader.h"
#include "formats/text/source_set.h"

#include "llvm/ADT/StringMap.h"

#include <map>
#include <memory>
#include <mutex>

namespace ncvet {

class Executor;
class Project;
class ReferenceReader;

/// A file with its dialect, reader, index and executor.
struct FileUnit {
  FileUnit(const SourceFile &file, std::shared_ptr<const Dialect> language,
           const MachineProfile &profile, FileScan *kept = nullptr);
  ~FileUnit();

  const SourceFile &source;
  std::shared_ptr<const Dialect> dialect;
  const MachineProfile &machine;
  std::unique_ptr<Reader> reader;
  FileIndex index;
  Project *project = nullptr;  ///< that it is a file of; null: it is alone
  llvm::StringMap<bool> hides; ///< names of the control's programs, as far as they were asked for

  const Executor &executor() const { return *executor_; }
  /// Reads what blocks of the file refer to; made when first asked for.
  const ReferenceReader &references() const;

private:
  /// A pointer: who only wants the files of an analysis need not see the machine's state.
  std::unique_ptr<const Executor> executor_;
  mutable std::unique_ptr<const ReferenceReader> references_;
};

/// Which programs lie in which folder; each folder is read once. Safe for several threads.
class ProgramFolders {
public:
  struct Programs {
    std::map<int64_t, std::string> byNumber; ///< file by program number
    std::multimap<int64_t, std::string>
        furtherByNumber;                 ///< more files with a program of the number
    llvm::StringMap<std::string> byName; ///< file by its name without ending, in capitals
  };
  /// Folders of a backup of a control, as the control would find a program in them.
  struct Stores {
    std::vector<std::string> searched; ///< in the order in which the control looks
    std::vector<std::string> further;  ///< workpieces, and folders in the searched ones
  };
  /// Programs of a folder, from file names like `O1234.nc` and from headers.
  const Programs &programs(const std::string &folder);
  /// The stores of the backup that `folder` is part of; `names` are those that a control has.
  const Stores &stores(const std::string &folder, llvm::ArrayRef<std::string> names);
  /// These files are checked together. Called before anything is looked up.
  void setChecked(llvm::ArrayRef<std::string> files);
  /// Files of that name, in capitals and without its ending, among those that are checked together.
  llvm::ArrayRef<std::string> checked(llvm::StringRef name) const;
  /// The folders of these files, sorted; none when there are too many to look through.
  llvm::ArrayRef<std::string> checkedFolders() const { return checkedFolders_; }
  /// What the files of each folder call.
  CallsOfFolders calls;

private:
  std::mutex mutex_;
  std::map<std::string, Programs> folders_;
  std::map<std::string, Stores> stores_;
  llvm::StringMap<std::vector<std::string>> checked_;
  std::vector<std::string> checkedFolders_;
};

/// Finds programs that a file calls: in the same file, then in files of the same folder, of the
/// folders where the control would look, of the search folders, and at last, when only one has the
/// name, among the files that are checked together.
class Project {
public:
  Project(SourceSet &sources, std::shared_ptr<const Dialect> dialect, MachineProfile machine,
          std::vector<std::string> searchFolders = {},
          std::shared_ptr<ProgramFolders> folders = std::make_shared<ProgramFolders>());

  /// The unit of a file of the set; made when first asked for, with what is kept of its text.
  FileUnit &unit(const SourceFile &file, FileScan *kept = nullptr);
  /// Where several files are analysed one after the other, which share those that they call:
  /// analyses `file` by `analysis`. While it lasts its path means this file.
  void withMain(const SourceFile &file, llvm::function_ref<void(FileUnit &)> analysis);
  /// Program `number` as seen from `from`: its unit and entry; null when there is none.
  using Found = std::pair<FileUnit *, const ProgramInfo *>;
  Found findProgram(FileUnit &from, int64_t number);
  /// The same for program `name`. A path before it is not followed.
  Found findProgram(FileUnit &from, llvm::StringRef name);
  /// Files of the folder of `from` whose names or first lines give program `number`, in the order
  /// of their paths.
  std::vector<std::string> filesOf(const FileUnit &from, int64_t number);
  /// Whether a program of the project is called where `from` names this program of the control: one
  /// of the same file or folder, or one that the file declares.
  bool hidesProgram(FileUnit &from, llvm::StringRef name);
  /// Whether a file of the name lies where the control does not look by itself: when
  /// `findProgram` gave none of them, nobody knows which one is called.
  bool liesElsewhere(const FileUnit &from, llvm::StringRef name);
  /// The unit of the file at `path`; null when it cannot be read.
  FileUnit *open(const std::string &path);
  /// The folder of a file, then those that are searched for every file.
  std::vector<std::string> foldersOf(const FileUnit &from) const;
  /// The folders of the files that are checked together.
  llvm::ArrayRef<std::string> foldersOfChecked() const { return folders_->checkedFolders(); }
  CallsOfFolders &callsOfFolders() { return folders_->calls; }
  const Dialect &dialect() const { return *dialect_; }
  const MachineProfile &machine() const { return machine_; }
  SourceSet &sources() { return sources_; }

private:
  /// The folder of a file; empty: it lies in none.
  static std::string folderOf(const FileUnit &from);
  /// `foldersOf` with the folders of the control's backup that the file is part of.
  std::vector<std::string> searchedFolders(const FileUnit &from);
  /// Files of this name where the control does not look by itself.
  std::vector<std::string> filesElsewhere(const FileUnit &from, llvm::StringRef name);
  /// Files of that number among those that are checked together.
  std::vector<std::string> filesElsewhere(const FileUnit &from, int64_t number);
  Found open(const std::string &file,
             llvm::function_ref<const ProgramInfo *(const FileIndex &)> programOf);
  /// Looks through the folders; `fileOf` picks a folder's file, `programOf` the program in it.
  Found searchFolders(FileUnit &from,
                      llvm::function_ref<std::string(const ProgramFolders::Programs &)> fileOf,
                      llvm::function_ref<const ProgramInfo *(const FileIndex &)> programOf);

  SourceSet &sources_;
  std::shared_ptr<const Dialect> dialect_;
  MachineProfile machine_;
  std::vector<std::string> searchFolders_;
  std::map<FileId, std::unique_ptr<FileUnit>> units_;
  llvm::StringMap<FileUnit *> byPath_; ///< of those with a path, the first of each
  std::shared_ptr<ProgramFolders> folders_;
};

} // namespace ncvet
