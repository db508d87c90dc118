// What is wrong with the files that setups come from, where the user sees it.
#include "lsp/server/setup_notices.h"

#include "formats/text/file_uri.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

namespace ncvet::lsp {

namespace {

/// Whole lines are marked; an editor cuts what goes over the end.
constexpr unsigned endOfLine = 1000;

struct PlacedError {
  std::string file; ///< empty: the error has no place
  unsigned line = 0;
  llvm::StringRef what;
};

/// Takes "FILE:LINE: what" apart. A drive letter has a colon of its own.
PlacedError placeOf(llvm::StringRef error) {
  for (size_t colon = error.find(':'); colon != llvm::StringRef::npos;
       colon = error.find(':', colon + 1)) {
    llvm::StringRef rest = error.substr(colon + 1);
    unsigned line = 0;
    if (!rest.consumeInteger(10, line) && line > 0 && rest.consume_front(": "))
      return {error.take_front(colon).str(), line - 1, rest};
  }
  return {"", 0, error};
}

} // namespace

void SetupNotices::publish(const std::string &file, const Json &diagnostics) {
  rpc_.notify("textDocument/publishDiagnostics",
              {{"uri", uriOfPath(file)}, {"diagnostics", diagnostics}});
}

bool SetupNotices::add(llvm::StringRef error) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!told_.insert(error.str()).second)
    return false;
  const PlacedError at = placeOf(error);
  llvm::SmallString<256> file = llvm::StringRef(at.file);
  if (file.empty() || llvm::sys::fs::make_absolute(file))
    return true;
  llvm::sys::path::remove_dots(file, /*remove_dot_dot=*/true);
  Json &list = files_[std::string(file)];
  if (!list.is_array())
    list = Json::array();
  list.push_back({{"range",
                   {{"start", {{"line", at.line}, {"character", 0}}},
                    {"end", {{"line", at.line}, {"character", endOfLine}}}}},
                  {"severity", 1},
                  {"source", "ncvet"},
                  {"code", "configuration"},
                  {"message", at.what.str()}});
  publish(std::string(file), list);
  return true;
}

std::string SetupNotices::message(llvm::StringRef error) {
  const PlacedError at = placeOf(error);
  if (at.file.empty())
    return error.str();
  const llvm::StringRef folder = llvm::sys::path::parent_path(at.file);
  return (llvm::sys::path::filename(at.file) + " line " + llvm::Twine(at.line + 1) + ": " +
          at.what + (folder.empty() ? "" : " (in " + folder + ")"))
      .str();
}

void SetupNotices::renew() {
  const std::lock_guard<std::mutex> lock(mutex_);
  told_.clear();
  for (const auto &[file, list] : std::exchange(files_, {}))
    publish(file, Json::array());
}

bool SetupNotices::any() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return !told_.empty();
}

} // namespace ncvet::lsp
