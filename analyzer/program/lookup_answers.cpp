// How the answers of lookups become hashes.
#include "analyzer/program/lookup_answers.h"

#include "analyzer/program/project.h"

#include "llvm/ADT/SmallVector.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/MemoryBuffer.h"
#include "llvm/Support/Path.h"
#include "llvm/Support/raw_ostream.h"
#include "llvm/Support/xxhash.h"

namespace ncvet {

namespace {

namespace fs = llvm::sys::fs;

/// Files that are longer are told apart by their size and time: none of them is read for the calls
/// in it, and no settings are as long.
constexpr uint64_t longestRead = 1u << 20;
/// What is read of one folder; the rest is told apart in the same way.
constexpr uint64_t mostRead = 64u << 20;

/// What an answer is made of, as one text.
class Answer {
public:
  template <typename T>
  Answer &operator<<(const T &part) {
    out_ << part << '\0';
    return *this;
  }
  uint64_t hash() const { return llvm::xxHash64(llvm::StringRef(text_.data(), text_.size())); }

private:
  llvm::SmallString<1024> text_;
  llvm::raw_svector_ostream out_{text_};
};

uint64_t textHash(llvm::StringRef file) {
  if (!fs::is_regular_file(file))
    return 0; // a device may never end
  const auto text = llvm::MemoryBuffer::getFile(file, /*IsText=*/false,
                                                /*RequiresNullTerminator=*/false);
  return text ? llvm::xxHash64((*text)->getBuffer()) : 0;
}

/// Names in a folder, sorted; those of folders or of others.
std::vector<std::string> entries(const std::string &folder, bool folders) {
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; i != end && !error; i.increment(error))
    if ((i->type() == fs::file_type::directory_file) == folders)
      found.push_back(i->path());
  llvm::sort(found);
  return found;
}

void writeFiles(const Lookup &lookup, Answer &answer) {
  uint64_t read = 0;
  for (const std::string &file : entries(lookup.path, /*folders=*/false)) {
    if (!llvm::StringRef(file).endswith_insensitive(lookup.names))
      continue;
    answer << file;
    fs::file_status status;
    if (fs::status(file, status) || !fs::is_regular_file(status))
      continue;
    answer << status.getSize();
    if (status.getSize() > longestRead || (read += status.getSize()) > mostRead)
      answer << status.getLastModificationTime().time_since_epoch().count();
    else
      answer << textHash(file);
  }
}

void writePrograms(const ProgramFolders::Programs &programs, Answer &answer) {
  for (const auto &[number, file] : programs.byNumber)
    answer << number << file;
  for (const auto &[number, file] : programs.furtherByNumber)
    answer << number << file;
  std::vector<std::string> names; // the map's own order is none
  for (const auto &entry : programs.byName)
    names.push_back((entry.getKey() + "\t" + entry.getValue()).str());
  llvm::sort(names);
  for (const std::string &name : names)
    answer << name;
}

} // namespace

uint64_t LookupAnswers::findOut(const Lookup &lookup) const {
  Answer answer;
  switch (lookup.kind) {
  case Lookup::Kind::Text:
    return textHash(lookup.path);
  case Lookup::Kind::Programs:
    writePrograms(folders_->programs(lookup.path), answer);
    break;
  case Lookup::Kind::Files:
    writeFiles(lookup, answer);
    break;
  case Lookup::Kind::Folders:
    for (const std::string &folder : entries(lookup.path, /*folders=*/true))
      answer << folder;
    break;
  case Lookup::Kind::Stores: {
    llvm::SmallVector<llvm::StringRef, 8> names;
    llvm::StringRef(lookup.names).split(names, '\n');
    const std::vector<std::string> owned(names.begin(), names.end());
    const ProgramFolders::Stores &stores = folders_->stores(lookup.path, owned);
    for (const std::string &store : stores.searched)
      answer << store;
    answer << "";
    for (const std::string &store : stores.further)
      answer << store;
    break;
  }
  case Lookup::Kind::Checked:
    for (const std::string &file : folders_->checked(lookup.path))
      answer << file;
    break;
  case Lookup::Kind::CheckedFolders:
    for (const std::string &folder : folders_->checkedFolders())
      answer << folder;
    break;
  }
  return answer.hash();
}

/// Unlocked while it is found out: several threads may do the same work, and none waits.
uint64_t LookupAnswers::of(const Lookup &lookup) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (const auto known = known_.find(lookup); known != known_.end())
      return known->second;
  }
  const uint64_t answer = findOut(lookup);
  const std::lock_guard<std::mutex> lock(mutex_);
  return known_.try_emplace(lookup, answer).first->second;
}

} // namespace ncvet
