// `--relative-to`: paths are shown as seen from another folder than the current one.
#include "analyzer/cli/relative_paths.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

namespace ncvet::cli {

namespace {

namespace path = llvm::sys::path;

void makeAbsolute(std::string &name) {
  if (name.empty() || name == "-" || path::is_absolute(name))
    return;
  llvm::SmallString<256> whole = llvm::StringRef(name);
  if (!llvm::sys::fs::make_absolute(whole)) {
    path::remove_dots(whole);
    name = std::string(whole);
  }
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
