// Stamps of the files of a check: what `ncvet check --watch` compares.
#include "analyzer/cli/file_stamps.h"

#include "analyzer/cli/absolute_path.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

namespace ncvet::cli {

namespace {

namespace fs = llvm::sys::fs;
namespace path = llvm::sys::path;

/// Names of one folder: one that holds more is no store of programs.
constexpr size_t mostNames = 20'000;

FileStamp stampOf(const fs::file_status &status) {
  return {FileStamp::Kind::File, status.getUniqueID().getDevice(), status.getUniqueID().getFile(),
          status.getSize(), status.getLastModificationTime()};
}

std::string folderOf(llvm::StringRef file) {
  const llvm::StringRef folder = path::parent_path(file);
  return folder.empty() ? "." : folder.str();
}

} // namespace

bool FileStamp::operator==(const FileStamp &other) const {
  const auto fields = [](const FileStamp &stamp) {
    return std::tie(stamp.kind, stamp.device, stamp.number, stamp.size, stamp.written);
  };
  return fields(*this) == fields(other);
}

FileStamps::FileStamps(const CheckRequest &request, llvm::ArrayRef<std::string> read) {
  addWritten(request);
  Session session(request.session); // another one each time: configurations may have changed
  const Inputs inputs = collectInputs(request.paths, session, request.inputs);
  programs_ = inputs.files.size();
  std::set<std::string> folders;
  for (const std::string &given : request.paths)
    folders.insert(fs::is_directory(given) ? given : folderOf(given));
  for (const Input &input : inputs.files)
    folders.insert(folderOf(input.path));
  for (const std::string &file : read)
    folders.insert(folderOf(file));
  for (const std::string &folder : std::set<std::string>(folders)) {
    if (const std::string file = findConfig(folder); !file.empty())
      addFile(meant_, file);
    auto config = session.config(folder);
    if (!config) {
      llvm::consumeError(config.takeError()); // the check tells it
      continue;
    }
    folders.insert((*config)->searchFolders.begin(), (*config)->searchFolders.end());
  }
  for (const std::string &folder : folders)
    addFolder(folder);
  for (const Input &input : inputs.files)
    addFile(meant_, input.path);
  for (const std::string &file : request.watched)
    addFile(meant_, file);
  for (const std::string &file : read)
    addFile(read_, file);
}

void FileStamps::addWritten(const CheckRequest &request) {
  for (const ReportTarget &target : request.reports)
    if (target.file != "-")
      writtenPaths_.insert(absolutePath(target.file));
  if (!request.timeTrace.empty())
    writtenPaths_.insert(absolutePath(request.timeTrace));
  // A report that goes into a file of a watched folder would call for the next one.
  for (const int stream : {1, 2}) { // standard output and error
    fs::file_status status;
    if (!fs::status(stream, status))
      written_.emplace(status.getUniqueID().getDevice(), status.getUniqueID().getFile());
  }
}

/// The names in a folder decide which programs are found; its tables and configurations are looked
/// at closer, as one that could not be read is none of the files that were read.
void FileStamps::addFolder(llvm::StringRef folder) {
  folders_.insert(folder.str());
  listed_.insert(folder.str());
  std::error_code error;
  size_t names = 0;
  for (fs::directory_iterator entry(folder, error), end;
       entry != end && !error && names < mostNames; entry.increment(error), ++names) {
    const llvm::StringRef name = path::filename(entry->path());
    if (entry->type() == fs::file_type::directory_file || name.startswith("."))
      continue;
    if (path::extension(name).equals_insensitive(".json"))
      addFile(meant_, entry->path());
    else if (!writtenPaths_.count(absolutePath(entry->path())))
      meant_[entry->path()].kind = FileStamp::Kind::Name;
  }
}

void FileStamps::addFile(Stamps &stamps, const std::string &file) {
  folders_.insert(folderOf(file));
  fs::file_status status;
  if (fs::status(file, status)) {
    stamps[file] = {};
    return;
  }
  const FileStamp stamp = stampOf(status);
  if (!written_.count({stamp.device, stamp.number}) && !writtenPaths_.count(absolutePath(file)))
    stamps[file] = stamp;
}

void FileStamps::addRead(const FileStamps &later, llvm::sys::TimePoint<> begin) {
  const auto known = [&](llvm::StringRef file) { return listed_.count(folderOf(file)) != 0; };
  const auto asRead = [&](const FileStamp &stamp) {
    return stamp.kind != FileStamp::Kind::File || stamp.written < begin ? stamp : FileStamp{};
  };
  // The folders of what was read are listed as well, and those of what is no longer read are not.
  for (auto at = meant_.begin(); at != meant_.end();)
    at = known(at->first) && !later.listed_.count(folderOf(at->first)) ? meant_.erase(at)
                                                                       : std::next(at);
  for (const auto &[file, stamp] : later.meant_)
    if (!known(file))
      meant_.try_emplace(file, asRead(stamp));
  const Stamps before = std::exchange(read_, {});
  for (const auto &[file, stamp] : later.read_) {
    const auto read = before.find(file);
    const auto meant = meant_.find(file);
    if (read != before.end())
      read_.insert(*read);
    else if (meant != meant_.end() && meant->second.kind == FileStamp::Kind::File)
      read_.insert(*meant);
    else
      read_[file] = asRead(stamp);
  }
  folders_ = later.folders_;
  listed_ = later.listed_;
}

std::string FileStamps::difference(const FileStamps &other) const {
  for (const auto &[mine, others] :
       {std::pair(&meant_, &other.meant_), std::pair(&read_, &other.read_)}) {
    for (const auto &[file, stamp] : *mine) {
      const auto found = others->find(file);
      if (found == others->end() || !(found->second == stamp))
        return file;
    }
    for (const auto &[file, stamp] : *others)
      if (!mine->count(file))
        return file;
  }
  return "";
}

} // namespace ncvet::cli
