// The folders of a backup of a control: where it looks for a program that is called.
#include "analyzer/program/project.h"
#include "formats/text/file_uri.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

#include <algorithm>
#include <set>

namespace ncvet {

namespace {

namespace path = llvm::sys::path;

/// A backup has a folder for each kind of program, and few levels in each.
constexpr unsigned mostLevelsUp = 6, mostLevelsDown = 4;
constexpr size_t mostFolders = 300;

/// Place in `names` of the folder's name: `SPF`, `SPF.DIR`, `_N_SPF_DIR`, or an ending like `.WPD`;
/// none: the control has no such folder.
std::optional<size_t> storeNamed(llvm::StringRef folder, llvm::ArrayRef<std::string> names) {
  llvm::StringRef bare = folder;
  const bool marked = bare.consume_front_insensitive("_N_");
  if (!bare.consume_back_insensitive(".DIR") && marked)
    bare.consume_back_insensitive("_DIR");
  for (size_t i = 0; i < names.size(); ++i) {
    const llvm::StringRef name = names[i];
    const bool same = name.startswith(".")
                          ? folder.endswith_insensitive(name) ||
                                (marked && bare.endswith_insensitive("_" + name.drop_front().str()))
                          : bare.equals_insensitive(name);
    if (same)
      return i;
  }
  return std::nullopt;
}

/// The folder that holds the stores, as seen from `folder`, which may lie deep in one of them.
std::string backupOf(const std::string &folder, llvm::ArrayRef<std::string> names) {
  llvm::SmallString<256> whole(folder);
  if (llvm::sys::fs::make_absolute(whole))
    return folder;
  path::remove_dots(whole, /*remove_dot_dot=*/true);
  unsigned up = 0;
  llvm::StringRef at = whole;
  for (unsigned level = 1; level <= mostLevelsUp && !at.empty(); ++level) {
    if (storeNamed(path::filename(at), names))
      up = level;
    at = path::parent_path(at);
  }
  std::string backup = folder;
  for (; up; --up) {
    const llvm::StringRef last = path::filename(backup);
    const llvm::StringRef parent = path::parent_path(backup);
    backup = last == "."      ? ".."
             : last == ".."   ? backup + "/.."
             : parent.empty() ? "."
                              : parent.str();
  }
  return backup;
}

std::vector<std::string> foldersIn(const std::string &folder) {
  std::vector<std::string> found;
  std::error_code error;
  for (llvm::sys::fs::directory_iterator i(folder, error), end; i != end && !error;
       i.increment(error))
    if (i->type() == llvm::sys::fs::file_type::directory_file && found.size() < mostFolders)
      found.push_back(slashed(i->path()));
  llvm::sort(found);
  return found;
}

/// All folders below, those that are nearer first.
void addBelow(const std::string &folder, unsigned levels, std::vector<std::string> &found) {
  for (const std::string &below : foldersIn(folder)) {
    if (!levels || found.size() >= mostFolders)
      return;
    found.push_back(below);
    addBelow(below, levels - 1, found);
  }
}

} // namespace

const ProgramFolders::Stores &ProgramFolders::stores(const std::string &folder,
                                                     llvm::ArrayRef<std::string> names) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto [at, fresh] = stores_.try_emplace(folder);
  Stores &stores = at->second;
  if (!fresh)
    return stores;
  std::vector<std::pair<size_t, std::string>> found;
  for (const std::string &store : foldersIn(backupOf(folder, names)))
    if (const auto place = storeNamed(path::filename(store), names))
      found.emplace_back(*place, store);
  llvm::sort(found);
  for (const auto &[place, store] : found) {
    const bool workpiece = llvm::StringRef(names[place]).startswith(".");
    (workpiece ? stores.further : stores.searched).push_back(store);
  }
  for (const auto &[place, store] : found)
    addBelow(store, mostLevelsDown, stores.further);
  return stores;
}

void ProgramFolders::setChecked(llvm::ArrayRef<std::string> files) {
  for (const std::string &file : files)
    checked_[path::stem(file).upper()].push_back(file);
  std::set<std::string> folders;
  for (const std::string &file : files) {
    const llvm::StringRef parent = path::parent_path(file);
    folders.insert(parent.empty() ? "." : parent.str());
  }
  constexpr size_t most = 100;
  if (folders.size() <= most)
    checkedFolders_.assign(folders.begin(), folders.end());
}

llvm::ArrayRef<std::string> ProgramFolders::checked(llvm::StringRef name) const {
  const auto found = checked_.find(name);
  return found == checked_.end() ? llvm::ArrayRef<std::string>()
                                 : llvm::makeArrayRef(found->second);
}

} // namespace ncvet
