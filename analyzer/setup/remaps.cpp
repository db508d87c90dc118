// Codes that a machine's INI file makes: LinuxCNC's REMAP.
#include "analyzer/setup/remaps.h"

#include "analyzer/program/lookups.h"
#include "formats/text/program_file.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/MemoryBuffer.h"
#include "llvm/Support/Path.h"
#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

namespace fs = llvm::sys::fs;
using Codes = std::map<std::string, std::string>; ///< the words that a code takes, by its name

constexpr unsigned foldersUp = 2;
constexpr unsigned mostFiles = 32;          // a folder of configurations has some
constexpr uint64_t mostBytes = 1024 * 1024; // an INI file has some thousand lines

/// `M428` and `G88.1` as tables name them, `G6.2` as `G06.2`; nothing for `T` and other words.
std::string nameOf(llvm::StringRef code) {
  const std::string upper = code.upper();
  llvm::StringRef digits = upper;
  if (!digits.consume_front("G") && !digits.consume_front("M"))
    return {};
  const auto [whole, part] = digits.split('.');
  const auto areDigits = [](llvm::StringRef text) { return llvm::all_of(text, llvm::isDigit); };
  if (whole.empty() || !areDigits(whole) || !areDigits(part) || digits.endswith("."))
    return {};
  const llvm::StringRef bare = whole.ltrim('0');
  return upper.substr(0, 1) + std::string(bare.size() < 2 ? 2 - bare.size() : 0, '0') + bare.str() +
         (part.empty() ? "" : "." + part.str());
}

/// `REMAP = M428 modalgroup=10 argspec=Pq ngc=switch`
void readLine(llvm::StringRef line, Codes &codes) {
  line = line.trim();
  if (!line.consume_front_insensitive("REMAP"))
    return;
  line = line.ltrim();
  if (!line.consume_front("="))
    return;
  llvm::SmallVector<llvm::StringRef, 8> words;
  line.split(words, ' ', -1, /*KeepEmpty=*/false);
  const std::string name = words.empty() ? std::string() : nameOf(words[0].trim());
  if (name.empty())
    return;
  std::string &taken = codes[name];
  for (llvm::StringRef word : words)
    if (word.consume_front_insensitive("argspec="))
      for (const char c : word.upper())
        if (llvm::isAlpha(c) && c != 'N' && taken.find(c) == std::string::npos)
          taken += c;
}

void readFile(llvm::StringRef path, Codes &codes) {
  uint64_t size = 0;
  if (!isRegularFile(path) || fs::file_size(path, size) || size > mostBytes)
    return;
  const auto text = llvm::MemoryBuffer::getFile(path);
  if (!text)
    return;
  llvm::StringRef rest = (*text)->getBuffer();
  while (!rest.empty()) {
    const auto [line, after] = rest.split('\n');
    readLine(line, codes);
    rest = after;
  }
}

/// The INI files of a folder, in the order of their names.
std::vector<std::string> iniFiles(llvm::StringRef folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (llvm::StringRef(entry->path()).endswith_insensitive(".ini"))
      files.push_back(entry->path());
  llvm::sort(files);
  if (files.size() > mostFiles)
    files.resize(mostFiles);
  return files;
}

} // namespace

void noteRemapsNear(llvm::StringRef folder) {
  llvm::SmallString<256> at = folder;
  if (!LookupRecord::current() || fs::make_absolute(at))
    return;
  for (unsigned up = 0; up <= foldersUp && !at.empty(); ++up) {
    noteLookup(Lookup::Kind::Files, at, ".ini");
    llvm::sys::path::remove_filename(at);
  }
}

std::optional<MachineSource> remapsNear(llvm::StringRef folder, const Dialect &dialect) {
  Codes codes;
  std::string first;
  llvm::SmallString<256> at = folder;
  if (fs::make_absolute(at))
    return std::nullopt;
  for (unsigned up = 0; up <= foldersUp && !at.empty(); ++up) {
    for (const std::string &file : iniFiles(at)) {
      const size_t known = codes.size();
      readFile(file, codes);
      if (first.empty() && codes.size() > known)
        first = file;
    }
    llvm::sys::path::remove_filename(at);
  }
  nlohmann::json made = nlohmann::json::object();
  for (const auto &remapped : codes) {
    const auto isIt = [&](const CodeInfo &code) { return code.name == remapped.first; };
    if (llvm::none_of(dialect.codes, isIt))
      made[remapped.first] = {{"does", "machine-specific"},
                              {"title", "remapped code"},
                              {"takes", remapped.second},
                              {"exclusive", remapped.first.front() == 'G'}};
  }
  if (made.empty())
    return std::nullopt;
  return MachineSource{first, nlohmann::json{{"codes", made}}.dump()};
}

} // namespace ncvet
