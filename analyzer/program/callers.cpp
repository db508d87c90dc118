// Who calls a program: blocks of its own file, and of the files round it.
#include "analyzer/program/callers.h"

#include "analyzer/program/block_reading.h"
#include "analyzer/program/call_reading.h"
#include "analyzer/program/lookups.h"
#include "analyzer/program/program_names.h"
#include "analyzer/program/references.h"
#include "formats/text/file_uri.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

#include <set>

namespace ncvet {

namespace {

/// No longer file is looked through for calls, in bytes.
constexpr size_t longest = 200000;

/// `SPF.DIR`, `CMA.DIR`, `SHAFT.WPD`: a folder of an archive, whose neighbours are searched too.
bool isArchiveFolder(llvm::StringRef path) {
  const llvm::StringRef ending = llvm::sys::path::extension(path);
  return ending.equals_insensitive(".DIR") || ending.equals_insensitive(".WPD");
}

/// A folder that holds the subprograms of the one above.
bool isForSubprograms(llvm::StringRef path) {
  const std::string name = llvm::sys::path::filename(path).lower();
  for (const llvm::StringRef known : {"sub", "subs", "spf", "subprograms", "macros"})
    if (name == known)
      return true;
  return false;
}

std::string parentOf(const std::string &folder) {
  llvm::SmallString<128> path(folder);
  if (llvm::sys::fs::make_absolute(path))
    return "";
  llvm::sys::path::remove_dots(path, /*remove_dot_dot=*/true);
  const llvm::StringRef parent = llvm::sys::path::parent_path(path);
  return llvm::sys::path::relative_path(parent).empty() ? "" : parent.str(); // not the root
}

/// The folders in which callers are looked for, first the file's own.
std::vector<std::string> foldersRound(const FileUnit &unit) {
  std::vector<std::string> folders = unit.project->foldersOf(unit);
  if (unit.source.path().empty())
    return folders;
  const std::string own = folders.front(); // the list grows
  const bool isArchive = isArchiveFolder(own);
  const std::string parent = isArchive || isForSubprograms(own) ? parentOf(own) : "";
  const auto add = [&](std::string folder) {
    if (!llvm::is_contained(folders, folder))
      folders.push_back(std::move(folder));
  };
  noteLookup(Lookup::Kind::CheckedFolders, "");
  for (const std::string &folder : unit.project->foldersOfChecked())
    if (!llvm::is_contained(folders, folder) && !llvm::sys::fs::equivalent(folder, own))
      add(folder);
  if (parent.empty())
    return folders;
  if (isArchive) {
    noteLookup(Lookup::Kind::Folders, parent);
    std::vector<std::string> beside;
    std::error_code error;
    for (llvm::sys::fs::directory_iterator i(parent, error), end; i != end && !error;
         i.increment(error))
      if (isArchiveFolder(i->path()) && !llvm::sys::fs::equivalent(i->path(), own))
        beside.push_back(slashed(i->path()));
    std::sort(beside.begin(), beside.end());
    for (std::string &folder : beside)
      add(std::move(folder));
  }
  add(parent);
  return folders;
}

const FolderCalls &callsIn(const FileUnit &unit, const std::string &folder) {
  llvm::StringRef ending = llvm::sys::path::extension(unit.source.path());
  ending.consume_front(".");
  noteLookup(Lookup::Kind::Files, folder);
  return unit.project->callsOfFolders().of({folder, ending.upper(), unit.dialect}, [&] {
    return readCalls(folder, ending, *unit.dialect);
  });
}

/// What calls of the program may name: its number, its name, that of its file.
std::set<std::string> keysOf(const FileUnit &unit, const ProgramInfo &program) {
  std::set<std::string> keys;
  if (program.number >= 0)
    keys.insert(std::to_string(program.number));
  if (!program.name.empty())
    keys.insert(program.name);
  llvm::StringRef stem = llvm::sys::path::stem(unit.source.path());
  if (&program == &unit.index.programs().front() && !stem.empty()) {
    keys.insert(stem.upper());
    stem.consume_front("%");
    stem.consume_front_insensitive("O");
    if (uint32_t number = 0; !stem.empty() && !stem.getAsInteger(10, number))
      keys.insert(std::to_string(number));
  }
  return keys;
}

bool meets(const std::set<std::string> &a, const std::set<std::string> &b) {
  return llvm::any_of(a, [&](const std::string &key) { return b.count(key) != 0; });
}

/// Finds the calls of one program.
class CallSearch {
public:
  CallSearch(FileUnit &unit, const ProgramInfo &program)
      : unit_(unit), program_(program), keys_(keysOf(unit, program)), references_(*unit.dialect) {}

  Callers run(bool inOwnFile) {
    if (inOwnFile)
      lookThrough(unit_);
    if (!unit_.project || unit_.source.path().empty())
      return std::move(callers_);
    for (const std::string &folder : foldersRound(unit_)) {
      const FolderCalls &calls = callsIn(unit_, folder);
      callers_.all &= calls.all;
      for (const FileCalls &file : calls.files)
        if (meets(file.calls, keys_) && !llvm::sys::fs::equivalent(file.path, unit_.source.path()))
          if (FileUnit *other = unit_.project->open(file.path))
            lookThrough(*other);
    }
    return std::move(callers_);
  }

private:
  void lookThrough(FileUnit &unit) {
    const llvm::StringRef text = unit.source.text();
    if (text.size() > longest) {
      callers_.all = false;
      return;
    }
    for (const ProgramInfo &one : unit.index.programs())
      for (const Block &block : blocks(unit.index, one.body, one.end))
        references_.all(block, text, [&](const Reference &reference) {
          if (reference.kind == ReferenceKind::Call && !reference.inCalled)
            call(unit, block, reference);
        });
  }

  void call(FileUnit &unit, const Block &block, const Reference &reference) {
    switch (reference.to) {
    case ReferredKind::UntoldProgram: // it may be this one
      callers_.all &= &unit != &unit_;
      return;
    case ReferredKind::Program:
      if (!keys_.count(std::to_string(reference.number)))
        return;
      break;
    case ReferredKind::NamedProgram:
      if (!keys_.count(bareProgramName(reference.text, *unit.dialect).upper()))
        return;
      break;
    default:
      return;
    }
    if (unit.project) {
      const auto place = resolveProgram(*unit.project, unit, reference);
      // A call that is not followed there is meant for this program, when it is written elsewhere.
      if (place ? place->program != &program_ : &unit == &unit_)
        return;
    } else if (unit.index.find(reference.number) != &program_) {
      return;
    }
    const bool repeats = llvm::any_of(block.items, [](const Item &item) {
      return item.kind == ItemKind::Call && (item.modal || item.count != noExpression);
    });
    callers_.places.push_back({&unit, block.begin, reference.runs == 1 && !repeats});
  }

  FileUnit &unit_;
  const ProgramInfo &program_;
  const std::set<std::string> keys_;
  const ReferenceReader references_;
  Callers callers_;
};

} // namespace

Callers callersOf(FileUnit &unit, const ProgramInfo &program) {
  return CallSearch(unit, program).run(/*inOwnFile=*/true);
}

Callers callersInOtherFiles(FileUnit &unit, const ProgramInfo &program) {
  return CallSearch(unit, program).run(/*inOwnFile=*/false);
}

std::vector<std::string> uncalledFilesBeside(FileUnit &unit) {
  std::vector<std::string> uncalled;
  if (!unit.project || unit.source.path().empty())
    return uncalled;
  const std::vector<std::string> folders = foldersRound(unit);
  const FolderCalls &own = callsIn(unit, folders.front());
  std::set<std::string> called;
  for (const std::string &folder : folders) {
    const FolderCalls &calls = callsIn(unit, folder);
    if (!calls.all)
      return uncalled;
    for (const FileCalls &file : calls.files) {
      if (file.untold)
        return uncalled;
      called.insert(file.calls.begin(), file.calls.end());
    }
  }
  for (const FileCalls &file : own.files)
    if (file.returns && !file.ends)
      if (FileUnit *other = unit.project->open(file.path))
        if (llvm::none_of(other->index.programs(), [&](const ProgramInfo &program) {
              return meets(keysOf(*other, program), called);
            }))
          uncalled.push_back(file.path);
  return uncalled;
}

} // namespace ncvet
