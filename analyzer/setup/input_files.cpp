// Inputs: walking folders for part programs.
#include "analyzer/setup/input_files.h"

#include "analyzer/setup/globs.h"
#include "formats/text/file_uri.h"

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
  Walker(Session &session, const InputChoice &choice, Inputs &inputs)
      : session_(session), choice_(choice), excluded_(choice.exclude), inputs_(inputs) {}

  void addNamed(llvm::StringRef file) {
    if (!choice_.forceExclude || !isExcluded(path::parent_path(file), file))
      addFile(file, /*named=*/true);
  }

  void addFolder(llvm::StringRef folder) {
    if (choice_.forceExclude && isExcluded(path::parent_path(folder), (folder + "/").str()))
      return;
    fs::UniqueID id;
    const bool again = !fs::getUniqueID(folder, id) && walked_.count(id);
    const size_t before = inputs_.files.size() + inputs_.errors.size();
    root_ = folder;
    leadingOut_ = 0;
    walkFrom(folder);
    if (leadingOut_)
      inputs_.warnings.push_back(
          (llvm::Twine(leadingOut_) + (leadingOut_ == 1 ? " link leads" : " links lead") +
           " out of " + folder + " and " + (leadingOut_ == 1 ? "is" : "are") +
           " left out; --follow-links follows " + (leadingOut_ == 1 ? "it" : "them"))
              .str());
    if (!again && before == inputs_.files.size() + inputs_.errors.size())
      inputs_.warnings.push_back(("no programs in " + folder + "; \"files\" in " + configFileName +
                                  " adds patterns of names")
                                     .str());
  }

private:
  void addFile(llvm::StringRef file, bool named) {
    llvm::StringRef display = file;
    while (display.consume_front("./"))
      display = display.ltrim('/');
    // Under one name programs find one another; `-` alone is standard input.
    const llvm::StringRef name = display == "-" ? file : display;
    inputs_.files.push_back({name.str(), path::convert_to_slash(display), named});
  }

  void walkFrom(llvm::StringRef folder) {
    if (!endings_)
      endings_ = Detector::builtinEndings();
    walk(folder);
  }

  void walk(llvm::StringRef folder) {
    // A folder that is linked into itself is walked once.
    fs::UniqueID id;
    if (fs::getUniqueID(folder, id) || !walked_.insert(id).second)
      return;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; entry != end && !error;
         entry.increment(error)) {
      const std::string file = slashed(entry->path());
      if (path::filename(file).startswith("."))
        continue;
      if (!choice_.followLinks && leadsOut(file, root_)) {
        ++leadingOut_;
        continue;
      }
      fs::file_status status;
      if (fs::status(file, status))
        continue; // a link to nothing
      if (fs::is_directory(status)) {
        if (!isExcluded(folder, file + "/"))
          walk(file);
      } else if (fs::is_regular_file(status) && isProgram(folder, file)) {
        addFile(file, /*named=*/false);
      }
    }
    if (error)
      inputs_.errors.push_back(("cannot read " + folder + ": " + error.message()).str());
  }

  bool isExcluded(llvm::StringRef folder, llvm::StringRef file) {
    if (!choice_.exclude.empty() && excluded_.match(pathBelow(".", file)))
      return true;
    const Config *config = configOf(folder);
    return config && globsOf(*config).exclude.match(pathBelow(config->folder, file));
  }

  bool isProgram(llvm::StringRef folder, llvm::StringRef file) {
    if (isExcluded(folder, file))
      return false;
    const Config *config = configOf(folder);
    if (config && globsOf(*config).files.match(pathBelow(config->folder, file)))
      return true;
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

  Session &session_;
  const InputChoice &choice_;
  const Globs excluded_;
  Inputs &inputs_;
  llvm::StringRef root_;  ///< the folder that was named
  size_t leadingOut_ = 0; ///< links below it
  std::optional<ProgramEndings> endings_;
  std::map<const Config *, ConfigGlobs> globs_;
  std::set<fs::UniqueID> walked_;
};

} // namespace

namespace {

std::string realPath(llvm::StringRef file) {
  llvm::SmallString<256> real;
  return fs::real_path(file, real) ? file.str() : std::string(real);
}

/// Of several paths to one file the shortest is kept, and one that is no link before one that is.
void dropRepeated(std::vector<Input> &files) {
  using Rank = std::tuple<bool, size_t, llvm::StringRef>;
  const auto rank = [](const Input &input) {
    return Rank(fs::is_symlink_file(input.path), input.display.size(), input.display);
  };
  std::map<std::string, const Input *> kept;
  for (const Input &input : files) {
    const Input *&best = kept[input.path == "-" ? input.path : realPath(input.path)];
    if (!best || rank(input) < rank(*best))
      best = &input;
  }
  std::set<const Input *> wanted;
  for (const auto &[real, input] : kept)
    wanted.insert(input);
  std::vector<Input> once;
  for (const Input &input : files)
    if (wanted.count(&input))
      once.push_back(input);
  files = std::move(once);
}

} // namespace

bool leadsOut(llvm::StringRef file, llvm::StringRef folder) {
  if (!fs::is_symlink_file(file))
    return false;
  const std::string inside = realPath(folder.empty() ? "." : folder), target = realPath(file);
  llvm::StringRef below = target;
  return !below.consume_front(inside) ||
         !(below.empty() || path::is_separator(below.front()) || inside == "/");
}

Inputs collectInputs(llvm::ArrayRef<std::string> paths, Session &session,
                     const InputChoice &choice) {
  Inputs inputs;
  Walker walker(session, choice, inputs);
  for (const std::string &given : paths) {
    const std::string name = slashed(given);
    if (name == "-") {
      inputs.files.push_back({"-", "<stdin>", true});
      continue;
    }
    fs::file_status status;
    if (const std::error_code error = fs::status(name, status))
      inputs.errors.push_back("cannot read " + name + ": " + error.message());
    else if (fs::is_directory(status))
      walker.addFolder(name);
    else
      walker.addNamed(name);
  }
  dropRepeated(inputs.files);
  llvm::stable_sort(inputs.files,
                    [](const Input &a, const Input &b) { return a.display < b.display; });
  return inputs;
}

} // namespace ncvet
