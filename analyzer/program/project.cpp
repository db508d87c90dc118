// The files of one analysis: the current program and those that it calls from elsewhere.
#include "analyzer/program/project.h"

#include "analyzer/program/block_reading.h"
#include "analyzer/program/lookups.h"
#include "analyzer/program/program_names.h"
#include "analyzer/program/reference_reader.h"
#include "formats/dialect/control_facts.h"
#include "formats/text/file_uri.h"
#include "formats/text/program_file.h"
#include "interp/execute/execute.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

namespace ncvet {

namespace {

/// Files of a folder whose first bytes are looked at for a program header: a shop's folder holds
/// hundreds, and a folder that is no program store must not be read as a whole.
constexpr unsigned maxHeaderFiles = 500;
constexpr size_t headerBytes = 4096;
/// Larger files are no subprograms.
constexpr uint64_t maxSubprogramBytes = 64u << 20;

/// `O1234.nc`, `1234`, `%O0012.txt`: the number; -1 for other names.
int64_t numberOfName(llvm::StringRef name) {
  llvm::StringRef stem = llvm::sys::path::stem(name);
  stem.consume_front("%");
  if (!stem.consume_front("O"))
    stem.consume_front("o");
  int64_t number = -1;
  if (stem.empty() || stem.size() > 9 || stem.getAsInteger(10, number))
    return -1;
  return number;
}

/// `EXTERN NAME`: the program says that it calls one of its own.
bool declares(const FileUnit &unit, llvm::StringRef name) {
  constexpr llvm::StringLiteral word = "EXTERN";
  const llvm::StringRef text = unit.source.text();
  // A reader of its own: this one is asked while the unit's reads a block.
  std::unique_ptr<Reader> reader;
  Block block;
  for (size_t at = text.find_insensitive(word); at != llvm::StringRef::npos;
       at = text.find_insensitive(word, at + 1)) {
    if (!text.drop_front(at + word.size()).ltrim(" \t").startswith_insensitive(name))
      continue;
    if (!reader)
      reader = makeReader(*unit.dialect, text);
    readBlockAt(unit.source, *reader, uint32_t(at), block);
    if (llvm::any_of(block.items, [&](const Item &item) {
          return item.kind == ItemKind::Declaration &&
                 unit.source.text(item.nameBegin, item.nameEnd).equals_insensitive(name);
        }))
      return true;
  }
  return false;
}

int64_t numberOfHeader(llvm::StringRef text) {
  unsigned lines = 0;
  while (!text.empty() && lines++ < 50) {
    llvm::StringRef line;
    std::tie(line, text) = text.split('\n');
    line = line.ltrim(" \t\r");
    line.consume_front("%");
    line = line.ltrim();
    if (!line.consume_front("O") && !line.consume_front(":"))
      continue;
    const llvm::StringRef digits = line.take_while([](char c) { return c >= '0' && c <= '9'; });
    int64_t number = -1;
    if (!digits.empty() && digits.size() <= 9 && !digits.getAsInteger(10, number))
      return number;
  }
  return -1;
}

} // namespace

FileUnit::FileUnit(const SourceFile &file, std::shared_ptr<const Dialect> language,
                   const MachineProfile &profile, FileScan *kept)
    : source(file), dialect(std::move(language)), machine(profile),
      reader(makeReader(*dialect, file.text())), index(file, *reader, *dialect, kept),
      executor_(std::make_unique<const Executor>(*dialect, machine, file.id())) {}

FileUnit::~FileUnit() = default;

const ReferenceReader &FileUnit::references() const {
  if (!references_)
    references_ = std::make_unique<const ReferenceReader>(*dialect);
  return *references_;
}

Project::Project(SourceSet &sources, std::shared_ptr<const Dialect> dialect, MachineProfile machine,
                 std::vector<std::string> searchFolders, std::shared_ptr<ProgramFolders> folders)
    : sources_(sources), dialect_(std::move(dialect)), machine_(std::move(machine)),
      searchFolders_(std::move(searchFolders)), folders_(std::move(folders)) {}

FileUnit &Project::unit(const SourceFile &file, FileScan *kept) {
  auto &unit = units_[file.id()];
  if (!unit) {
    unit = std::make_unique<FileUnit>(file, dialect_, machine_, kept);
    unit->project = this;
    if (!file.path().empty())
      byPath_.try_emplace(file.path(), unit.get());
    if (!dialect_->hiddenPrograms.empty())
      unit->reader->setHidesProgram(
          [this, &from = *unit](llvm::StringRef name) { return hidesProgram(from, name); });
  }
  return *unit;
}

void Project::withMain(const SourceFile &file, llvm::function_ref<void(FileUnit &)> analysis) {
  FileUnit &main = unit(file);
  FileUnit *called = nullptr; // by another file, under the same path
  if (!file.path().empty())
    called = std::exchange(byPath_[file.path()], &main);
  analysis(main);
  if (called && called != &main)
    byPath_[file.path()] = called;
  else
    byPath_.erase(file.path());
  units_.erase(file.id());
}

const ProgramFolders::Programs &ProgramFolders::programs(const std::string &path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto [at, fresh] = folders_.try_emplace(path);
  Programs &programs = at->second;
  if (!fresh)
    return programs;
  std::vector<std::string> files;
  std::error_code error;
  for (llvm::sys::fs::directory_iterator i(path, error), end; i != end && !error;
       i.increment(error)) {
    using llvm::sys::fs::file_type;
    const file_type type = i->type();
    if (type != file_type::regular_file && type != file_type::symlink_file &&
        type != file_type::type_unknown)
      continue; // a folder, or what would never end
    const std::string file = slashed(i->path());
    llvm::StringRef name = file;
    name.consume_front("./"); // as the user names the files of the present folder
    files.push_back(name.str());
    if (files.size() > 20000) // not a program store
      break;
  }
  std::sort(files.begin(), files.end());
  const auto add = [&](int64_t number, const std::string &file) {
    if (number >= 0 && !programs.byNumber.try_emplace(number, file).second)
      programs.furtherByNumber.emplace(number, file);
  };
  for (const std::string &file : files) {
    add(numberOfName(llvm::sys::path::filename(file)), file);
    programs.byName.try_emplace(llvm::sys::path::stem(file).upper(), file);
  }
  unsigned looked = 0;
  for (const std::string &file : files) {
    uint64_t size = 0;
    if (numberOfName(llvm::sys::path::filename(file)) >= 0 || looked >= maxHeaderFiles ||
        !isRegularFile(file) || llvm::sys::fs::file_size(file, size) || size > maxSubprogramBytes)
      continue;
    ++looked;
    const auto buffer =
        llvm::MemoryBuffer::getFileSlice(file, std::min<uint64_t>(size, headerBytes), 0);
    if (!buffer)
      continue;
    add(numberOfHeader((*buffer)->getBuffer()), file);
  }
  return programs;
}

std::string Project::folderOf(const FileUnit &from) {
  if (from.source.path().empty())
    return {};
  const llvm::StringRef parent = llvm::sys::path::parent_path(from.source.path());
  return parent.empty() ? "." : parent.str();
}

std::vector<std::string> Project::filesOf(const FileUnit &from, int64_t number) {
  std::vector<std::string> files;
  const std::string folder = folderOf(from);
  if (folder.empty())
    return files;
  noteLookup(Lookup::Kind::Programs, folder);
  const ProgramFolders::Programs &programs = folders_->programs(folder);
  if (const auto first = programs.byNumber.find(number); first != programs.byNumber.end())
    files.push_back(first->second);
  const auto [begin, end] = programs.furtherByNumber.equal_range(number);
  for (auto further = begin; further != end; ++further)
    files.push_back(further->second);
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> Project::foldersOf(const FileUnit &from) const {
  std::vector<std::string> folders;
  if (const std::string own = folderOf(from); !own.empty())
    folders.push_back(own);
  folders.insert(folders.end(), searchFolders_.begin(), searchFolders_.end());
  return folders;
}

std::vector<std::string> Project::searchedFolders(const FileUnit &from) {
  std::vector<std::string> folders = foldersOf(from);
  const std::vector<std::string> &names = dialect_->facts->program.folders;
  if (names.empty() || from.source.path().empty())
    return folders;
  noteLookup(Lookup::Kind::Stores, folders.front(), llvm::join(names, "\n"));
  for (const std::string &store : folders_->stores(folders.front(), names).searched)
    if (!llvm::is_contained(folders, store))
      folders.push_back(store);
  return folders;
}

namespace {

/// Notes what is known of a file that a check of another file may have opened already.
FileUnit *noted(FileUnit *unit) {
  LookupRecord *const record = LookupRecord::current();
  if (!record)
    return unit;
  record->noteText(unit->source);
  if (!unit->dialect->hiddenPrograms.empty()) // its blocks are read under what hides them
    for (const std::string &folder : unit->project->foldersOf(*unit))
      noteLookup(Lookup::Kind::Programs, folder);
  return unit;
}

} // namespace

/// A file of this project keeps its number. Others' files in the set are left alone: they may be at
/// work on another thread.
FileUnit *Project::open(const std::string &path) {
  if (const auto known = byPath_.find(path); known != byPath_.end())
    return noted(known->second);
  auto opened = sources_.open(path);
  if (opened)
    return noted(&unit(**opened));
  llvm::consumeError(opened.takeError());
  noteLookup(Lookup::Kind::Text, path);
  return nullptr;
}

Project::Found
Project::searchFolders(FileUnit &from,
                       llvm::function_ref<std::string(const ProgramFolders::Programs &)> fileOf,
                       llvm::function_ref<const ProgramInfo *(const FileIndex &)> programOf) {
  for (const std::string &path : searchedFolders(from)) {
    noteLookup(Lookup::Kind::Programs, path);
    const std::string name = fileOf(folders_->programs(path));
    if (name.empty())
      continue;
    if (const Found found = open(name, programOf); found.first)
      return found;
  }
  return {nullptr, nullptr};
}

Project::Found Project::open(const std::string &name,
                             llvm::function_ref<const ProgramInfo *(const FileIndex &)> programOf) {
  FileUnit *const opened = open(name);
  if (!opened)
    return {nullptr, nullptr};
  FileUnit &other = *opened;
  if (const ProgramInfo *program = programOf(other.index))
    return {&other, program};
  // The file's name says which program it is; what it holds needs no header of its own.
  if (!other.index.programs().empty() && !other.index.programs()[0].hasHeader())
    return {&other, &other.index.programs()[0]};
  return {nullptr, nullptr};
}

std::vector<std::string> Project::filesElsewhere(const FileUnit &from, llvm::StringRef name) {
  std::vector<std::string> files;
  if (from.source.path().empty())
    return files;
  const std::vector<std::string> &names = dialect_->facts->program.folders;
  const std::string key = name.upper();
  noteLookup(Lookup::Kind::Checked, key);
  if (!names.empty()) {
    noteLookup(Lookup::Kind::Stores, folderOf(from), llvm::join(names, "\n"));
    for (const std::string &folder : folders_->stores(folderOf(from), names).further) {
      noteLookup(Lookup::Kind::Programs, folder);
      const ProgramFolders::Programs &programs = folders_->programs(folder);
      if (const auto file = programs.byName.find(key); file != programs.byName.end())
        files.push_back(file->second);
    }
  }
  for (const std::string &file : folders_->checked(key))
    if (!llvm::is_contained(files, file))
      files.push_back(file);
  llvm::erase_if(files, [&](const std::string &file) {
    llvm::StringRef ending = llvm::sys::path::extension(file);
    ending.consume_front(".");
    return file == from.source.path() || (!names.empty() && !isProgramEnding(ending, *dialect_));
  });
  return files;
}

std::vector<std::string> Project::filesElsewhere(const FileUnit &from, int64_t number) {
  std::vector<std::string> files;
  noteLookup(Lookup::Kind::CheckedFolders, "");
  for (const std::string &folder : folders_->checkedFolders()) {
    noteLookup(Lookup::Kind::Programs, folder);
    const ProgramFolders::Programs &programs = folders_->programs(folder);
    const auto file = programs.byNumber.find(number);
    if (file != programs.byNumber.end() && file->second != from.source.path())
      files.push_back(file->second);
  }
  return files;
}

bool Project::liesElsewhere(const FileUnit &from, llvm::StringRef name) {
  return !filesElsewhere(from, bareProgramName(name, *from.dialect)).empty();
}

Project::Found Project::findProgram(FileUnit &from, int64_t number) {
  if (const ProgramInfo *program = from.index.find(number))
    return {&from, program};
  const auto programOf = [number](const FileIndex &index) { return index.find(number); };
  const Found found = searchFolders(
      from,
      [number](const ProgramFolders::Programs &programs) {
        const auto file = programs.byNumber.find(number);
        return file == programs.byNumber.end() ? std::string() : file->second;
      },
      programOf);
  if (found.first)
    return found;
  // Which of several it is depends on what the machine has loaded.
  const std::vector<std::string> files = filesElsewhere(from, number);
  return files.size() == 1 ? open(files.front(), programOf) : Found{nullptr, nullptr};
}

Project::Found Project::findProgram(FileUnit &from, llvm::StringRef name) {
  if (const ProgramInfo *program = from.index.find(name))
    return {&from, program};
  if (const llvm::StringRef bare = bareProgramName(name, *from.dialect);
      bare.size() < name.size()) {
    name = bare;
    if (const ProgramInfo *program = from.index.find(name))
      return {&from, program};
  }
  const std::string key = name.upper();
  // Where a call names a file, the number of the program in it does not matter.
  const bool anyIn = dialect_->lexical.fileInComment;
  const auto programOf = [name, anyIn](const FileIndex &index) {
    const ProgramInfo *const program = index.find(name);
    return program || !anyIn || index.programs().empty() ? program : &index.programs().front();
  };
  const Found found = searchFolders(
      from,
      [&key](const ProgramFolders::Programs &programs) {
        const auto file = programs.byName.find(key);
        return file == programs.byName.end() ? std::string() : file->second;
      },
      programOf);
  if (found.first)
    return found;
  // Which of several it is depends on what the machine has loaded.
  const std::vector<std::string> files = filesElsewhere(from, name);
  return files.size() == 1 ? open(files.front(), programOf) : Found{nullptr, nullptr};
}

bool Project::hidesProgram(FileUnit &from, llvm::StringRef name) {
  const std::string key = name.upper();
  const auto [known, fresh] = from.hides.try_emplace(key, false);
  if (!fresh)
    return known->second;
  const auto isProgramFile = [&](llvm::StringRef path) {
    llvm::StringRef ending = llvm::sys::path::extension(path);
    ending.consume_front(".");
    const auto same = [&](const std::string &one) { return ending.equals_insensitive(one); };
    if (dialect_->mainExtensions.empty() && dialect_->subprogramExtensions.empty())
      return ending.empty() || llvm::any_of(dialect_->extensions, same);
    return isProgramEnding(ending, *dialect_);
  };
  bool hides = from.index.find(name) || declares(from, name);
  for (const std::string &folder : foldersOf(from)) {
    if (hides)
      break;
    noteLookup(Lookup::Kind::Programs, folder);
    const ProgramFolders::Programs &programs = folders_->programs(folder);
    const auto file = programs.byName.find(key);
    hides = file != programs.byName.end() && isProgramFile(file->second);
  }
  return from.hides[key] = hides;
}

} // namespace ncvet
