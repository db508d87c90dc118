// Inputs: walking folders for part programs.
#include "analyzer/setup/input_files.h"

#include "analyzer/setup/globs.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

#include <set>

namespace ncvet {

namespace {

namespace fs = llvm::sys::fs;
namespace path = llvm::sys::path;

/// Bytes that are read of a file whose ending does not say what it is.
constexpr size_t lookedAt = 4096;

class Walker {
public:
  Walker(Session &session, Inputs &inputs) : session_(session), inputs_(inputs) {}

  void addFile(llvm::StringRef file) {
    llvm::StringRef display = file;
    while (display.consume_front("./"))
      display = display.ltrim('/');
    inputs_.files.push_back({file.str(), path::convert_to_slash(display)});
  }

  void addFolder(llvm::StringRef folder) {
    if (!endings_) {
      auto endings = Detector::builtinEndings();
      if (!endings) {
        inputs_.errors.push_back(llvm::toString(endings.takeError()));
        return;
      }
      endings_ = std::move(*endings);
    }
    walk(folder);
  }

private:
  void walk(llvm::StringRef folder) {
    // A folder that is linked into itself is walked once.
    fs::UniqueID id;
    if (fs::getUniqueID(folder, id) || !walked_.insert(id).second)
      return;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; entry != end && !error;
         entry.increment(error)) {
      const std::string file = entry->path();
      if (path::filename(file).startswith("."))
        continue;
      fs::file_status status;
      if (fs::status(file, status))
        continue; // a link to nothing
      if (fs::is_directory(status)) {
        if (!isExcluded(folder, file + "/"))
          walk(file);
      } else if (fs::is_regular_file(status) && isProgram(folder, file)) {
        addFile(file);
      }
    }
    if (error)
      inputs_.errors.push_back(("cannot read " + folder + ": " + error.message()).str());
  }

  bool isExcluded(llvm::StringRef folder, llvm::StringRef file) {
    const Config *config = configOf(folder);
    return config && globsOf(*config).exclude.match(relative(*config, file));
  }

  bool isProgram(llvm::StringRef folder, llvm::StringRef file) {
    const Config *config = configOf(folder);
    if (config) {
      const std::string name = relative(*config, file);
      const ConfigGlobs &globs = globsOf(*config);
      if (globs.exclude.match(name))
        return false;
      if (globs.files.match(name))
        return true;
    }
    std::string ending = path::extension(file).lower();
    ending.erase(0, std::min<size_t>(1, ending.size()));
    if (llvm::is_contained(endings_->sure, ending))
      return true;
    if (!llvm::is_contained(endings_->loose, ending))
      return false;
    uint64_t size = 0;
    if (fs::file_size(file, size))
      return true; // it is told later why it cannot be read
    const auto text = llvm::MemoryBuffer::getFileSlice(file, std::min<uint64_t>(size, lookedAt), 0);
    return !text || looksLikeProgram((*text)->getBuffer());
  }

  /// Those of a configuration that the session keeps.
  struct ConfigGlobs {
    explicit ConfigGlobs(const Config &config) : files(config.files), exclude(config.exclude) {}
    Globs files, exclude;
  };
  const ConfigGlobs &globsOf(const Config &config) {
    return globs_.try_emplace(&config, config).first->second;
  }

  /// Configuration of a folder; null when there is none or it is wrong, which is told per file.
  const Config *configOf(llvm::StringRef folder) {
    auto config = session_.config(folder);
    if (!config) {
      llvm::consumeError(config.takeError());
      return nullptr;
    }
    return config->get(); // the session keeps it
  }

  /// `file` as seen from the configuration's folder.
  static std::string relative(const Config &config, llvm::StringRef file) {
    llvm::SmallString<256> from(config.folder), to(file);
    const bool isFolder = file.endswith("/");
    if (fs::make_absolute(from) || fs::make_absolute(to))
      return file.str();
    path::remove_dots(from, true);
    path::remove_dots(to, true);
    llvm::StringRef name = to;
    if (name.consume_front(from))
      name = name.ltrim('/');
    return isFolder ? (name + "/").str() : name.str();
  }

  Session &session_;
  Inputs &inputs_;
  std::optional<ProgramEndings> endings_;
  std::map<const Config *, ConfigGlobs> globs_;
  std::set<fs::UniqueID> walked_;
};

} // namespace

Inputs collectInputs(llvm::ArrayRef<std::string> paths, Session &session) {
  Inputs inputs;
  Walker walker(session, inputs);
  for (const std::string &name : paths) {
    if (name == "-") {
      inputs.files.push_back({"-", "<stdin>"});
      continue;
    }
    fs::file_status status;
    if (const std::error_code error = fs::status(name, status))
      inputs.errors.push_back("cannot read " + name + ": " + error.message());
    else if (fs::is_directory(status))
      walker.addFolder(name);
    else
      walker.addFile(name);
  }
  llvm::stable_sort(inputs.files,
                    [](const Input &a, const Input &b) { return a.display < b.display; });
  inputs.files.erase(
      std::unique(inputs.files.begin(), inputs.files.end(),
                  [](const Input &a, const Input &b) { return a.display == b.display; }),
      inputs.files.end());
  return inputs;
}

} // namespace ncvet
