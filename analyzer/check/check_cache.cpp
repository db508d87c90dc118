// Outcomes of earlier runs in a folder: their names, their reading and writing.
#include "analyzer/check/check_cache.h"

#include "analyzer/check/check_settings.h"
#include "analyzer/check/outcome_bytes.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/CachePruning.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/FileUtilities.h"
#include "llvm/Support/Path.h"
#include "llvm/Support/SHA1.h"
#include "llvm/Support/raw_ostream.h"
#include "llvm/Support/xxhash.h"

namespace ncvet {

namespace {

namespace fs = llvm::sys::fs;
namespace path = llvm::sys::path;

/// The form of the files: other ones are none of ours.
constexpr llvm::StringLiteral form = "ncvet outcome 3\n";
/// An outcome is some findings: one with the most that rules may make takes less.
constexpr uint64_t largestOutcome = 64u << 20;
/// What is not used for so long belongs to programs that are done.
constexpr auto longestKept = std::chrono::hours(30 * 24);
/// Outcomes of a few hundred thousand programs.
constexpr uint64_t mostKept = 512u << 20;

/// Which build of ncvet this is: rules and tables are part of it. Empty: not known.
std::string thisBuild() {
  const std::string program = fs::getMainExecutable(nullptr, reinterpret_cast<void *>(&thisBuild));
  fs::file_status status;
  if (program.empty() || fs::status(program, status))
    return "";
  return (program + "\n" + llvm::Twine(status.getSize()) + " " +
          llvm::Twine(status.getLastModificationTime().time_since_epoch().count()))
      .str();
}

std::string usersFolder() {
  llvm::SmallString<256> folder;
  if (!path::cache_directory(folder))
    return "";
  path::append(folder, "ncvet");
  return std::string(folder);
}

} // namespace

std::unique_ptr<CheckCache> CheckCache::open(llvm::StringRef folder, Session &session,
                                             SourceSet &sources) {
  std::string at = folder.empty() ? usersFolder() : folder.str(), build = thisBuild();
  if (at.empty() || build.empty() ||
      fs::create_directories(at, /*IgnoreExisting=*/true, fs::owner_all))
    return nullptr;
  return std::unique_ptr<CheckCache>(
      new CheckCache(std::move(at), std::move(build), session, sources));
}

std::string CheckCache::settingsFor(const std::shared_ptr<const Config> &config) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string &known = settings_[config];
  if (known.empty())
    known = settingsText(session_.options(), *config, answers_);
  return known;
}

std::optional<std::string> CheckCache::pathFor(const SourceFile &file, const OuterCalls &outer) {
  auto config = session_.configOf(file.path().empty() ? file.display() : file.path());
  if (!config) {
    llvm::consumeError(config.takeError()); // the check tells it
    return std::nullopt;
  }
  // Where a relative path leads, and what the folders above it are called, is part of it.
  llvm::SmallString<256> current;
  if (fs::current_path(current))
    return std::nullopt;
  std::string key = build_;
  llvm::raw_string_ostream(key) << '\n'
                                << current << '\n'
                                << settingsFor(*config) << file.path() << '\0' << file.display()
                                << '\0' << file.text().size() << ' ' << llvm::xxHash64(file.text());
  llvm::raw_string_ostream out(key);
  for (const auto &[block, groups] : outer.followed)
    out << ' ' << block << ' ' << groups;
  if (outer.work)
    out << " work " << *outer.work;
  if (outer.circle)
    out << " circle " << llvm::join(*outer.circle, "\n");
  out.flush();
  llvm::SHA1 hash;
  hash.update(key);
  llvm::SmallString<256> at(folder_);
  // The name that the library looks for when it removes old ones.
  path::append(at, "llvmcache-" + llvm::toHex(hash.final(), /*LowerCase=*/true));
  return std::string(at);
}

std::optional<FileOutcome> CheckCache::find(const std::string &path, const SourceFile &file,
                                            Opened &opened) {
  uint64_t size = 0;
  if (fs::file_size(path, size) || size > largestOutcome)
    return std::nullopt;
  const auto buffer = llvm::MemoryBuffer::getFile(path, /*IsText=*/false,
                                                  /*RequiresNullTerminator=*/false);
  llvm::StringRef bytes = buffer ? (*buffer)->getBuffer() : llvm::StringRef();
  if (!bytes.consume_front(form))
    return std::nullopt;
  ByteReader in(bytes);
  const uint64_t hash = in.number();
  if (in.failed() || hash != llvm::xxHash64(in.rest()))
    return std::nullopt; // half written, or damaged
  for (uint64_t left = in.number(); left && !in.failed(); --left) {
    Lookup lookup;
    lookup.kind = Lookup::Kind(in.number(Lookup::kinds));
    lookup.path = in.text().str();
    lookup.names = in.text().str();
    if (const uint64_t answer = in.number(); in.failed() || answers_.of(lookup) != answer)
      return std::nullopt;
  }
  return outcomeOf(in.rest(), file, [&](llvm::StringRef called) -> const SourceFile * {
    const SourceFile *&known = opened[called];
    if (known)
      return known;
    auto source = sources_.open(called);
    if (source)
      return known = *source;
    llvm::consumeError(source.takeError());
    return nullptr;
  });
}

void CheckCache::keep(const std::string &path, const SourceFile &file, const FileOutcome &outcome,
                      const LookupRecord &record) {
  ByteWriter lookups;
  lookups.number(record.answers().size());
  for (const auto &[lookup, answer] : record.answers()) {
    lookups.number(uint64_t(lookup.kind));
    lookups.text(lookup.path);
    lookups.text(lookup.names);
    lookups.number(answer);
  }
  const std::string content = lookups.take() + outcomeBytes(outcome, file, sources_);
  ByteWriter hash;
  hash.number(llvm::xxHash64(content));
  if (llvm::Error wrong = llvm::writeFileAtomically(path + ".%%%%%%%%", path,
                                                    (form + hash.take() + content).str())) {
    llvm::consumeError(std::move(wrong)); // a check without a cache is only slower
    full_ = true;
  }
}

FileOutcome CheckCache::check(const SourceFile &file, const std::atomic<bool> *cancel,
                              CheckStore &store, Opened &opened) {
  const std::optional<std::string> path = pathFor(file, store.outer);
  if (!path)
    return checkFile(session_, sources_, file, cancel, nullptr, &store);
  if (auto known = find(*path, file, opened)) {
    known->postponed = known->asksOuter && store.outer.postpones;
    known_ += !known->postponed;
    return std::move(*known);
  }
  const LookupRecord record(answers_);
  FileOutcome outcome = checkFile(session_, sources_, file, cancel, nullptr, &store);
  const bool isWhole = outcome.error.empty() && !outcome.postponed && !outcome.restsOnOthers;
  if (isWhole && !full_ && !(cancel && *cancel))
    keep(*path, file, outcome, record);
  return outcome;
}

void CheckCache::prune() const {
  llvm::CachePruningPolicy policy;
  policy.Expiration = longestKept;
  policy.MaxSizeBytes = mostKept;
  llvm::pruneCache(folder_, policy);
}

} // namespace ncvet
