// Paths as reports show them: `--relative-to`, and the folder that holds all files.
#include "analyzer/cli/relative_paths.h"

#include "analyzer/cli/absolute_path.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

namespace ncvet::cli {

namespace {

namespace path = llvm::sys::path;

void makeAbsolute(std::string &name) {
  if (name.empty() || name == "-" || path::is_absolute(name))
    return;
  name = absolutePath(name);
}

/// `name` (absolute) as seen from `folder` (absolute).
std::string seenFrom(llvm::StringRef folder, llvm::StringRef name) {
  llvm::SmallString<256> clean = name;
  path::remove_dots(clean, /*remove_dot_dot=*/true);
  auto from = path::begin(folder), to = path::begin(clean);
  const auto fromEnd = path::end(folder), toEnd = path::end(clean);
  for (; from != fromEnd && to != toEnd && *from == *to; ++from, ++to)
    ;
  llvm::SmallString<256> result;
  for (; from != fromEnd; ++from)
    path::append(result, "..");
  for (; to != toEnd; ++to)
    path::append(result, *to);
  return result.empty() ? "." : std::string(result);
}

} // namespace

std::string folderFromRoot(llvm::ArrayRef<Job> jobs) {
  size_t above = 0;
  for (const Job &job : jobs) {
    size_t count = 0;
    for (llvm::StringRef rest = job.input.display; rest.consume_front("../");)
      ++count;
    above = std::max(above, count);
  }
  llvm::SmallString<128> at;
  if (above == 0 || llvm::sys::fs::current_path(at))
    return "";
  std::string folder;
  for (; above && path::has_filename(at); --above) {
    folder = (path::filename(at) + (folder.empty() ? "" : "/") + folder).str();
    path::remove_filename(at);
  }
  return folder;
}

llvm::Error showRelativeTo(const std::string &folder, CheckRequest &request) {
  std::string root = folder;
  makeAbsolute(root);
  llvm::SmallString<256> clean = llvm::StringRef(root);
  path::remove_dots(clean, /*remove_dot_dot=*/true);
  for (std::string &name : request.paths)
    if (name != "-") {
      makeAbsolute(name);
      name = seenFrom(clean, name);
    }
  if (!request.stdinFilename.empty()) {
    makeAbsolute(request.stdinFilename);
    request.stdinFilename = seenFrom(clean, request.stdinFilename);
  }
  for (ReportTarget &target : request.reports)
    makeAbsolute(target.file);
  for (std::string *name : {&request.baseline, &request.writeBaseline, &request.timeTrace,
                            &request.session.configFile, &request.changedLines})
    makeAbsolute(*name);
  if (llvm::StringRef(request.session.dialect).endswith(".json"))
    makeAbsolute(request.session.dialect);
  if (const std::error_code error = llvm::sys::fs::set_current_path(clean))
    return failure("--relative-to " + llvm::Twine(folder) + ": " + error.message());
  return llvm::Error::success();
}

} // namespace ncvet::cli
