// Reads which files of a folder call which programs.
#include "analyzer/program/call_reading.h"

#include "analyzer/program/block_reading.h"
#include "analyzer/program/program_names.h"
#include "analyzer/program/references.h"
#include "formats/readers/table_words.h"
#include "formats/text/file_uri.h"
#include "formats/text/program_file.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

namespace ncvet {

namespace {

/// A shop's folder holds hundreds of programs; more of them, or longer ones, are no store of
/// programs that call each other.
constexpr size_t mostFiles = 500;
constexpr uint64_t mostBytes = 8u << 20, longestFile = 1u << 20;

bool isProgram(llvm::StringRef path, llvm::StringRef wanted, const Dialect &dialect) {
  llvm::StringRef ending = llvm::sys::path::extension(path);
  ending.consume_front(".");
  const auto same = [&](llvm::StringRef one) { return ending.equals_insensitive(one); };
  return same(wanted) || llvm::any_of(dialect.extensions, same) || isProgramEnding(ending, dialect);
}

/// The files of a folder that may be programs of the control, in order.
std::vector<std::string> programFiles(const std::string &folder, llvm::StringRef ending,
                                      const Dialect &dialect) {
  std::vector<std::string> files;
  std::error_code error;
  for (llvm::sys::fs::directory_iterator i(folder, error), end; i != end && !error;
       i.increment(error)) {
    const std::string path = slashed(i->path());
    llvm::StringRef name = path;
    name.consume_front("./"); // as the user names the files of the present folder
    if (i->type() != llvm::sys::fs::file_type::directory_file && isProgram(name, ending, dialect))
      files.push_back(name.str());
    if (files.size() > mostFiles)
      break;
  }
  std::sort(files.begin(), files.end());
  return files;
}

FileCalls callsIn(std::string path, llvm::StringRef text, const Dialect &dialect,
                  const ReferenceReader &references) {
  FileCalls file;
  file.path = std::move(path);
  const std::unique_ptr<Reader> reader = makeReader(dialect, text);
  for (const Block &block : blocks(*reader)) {
    references.all(block, text, [&](const Reference &reference) {
      if (reference.to == ReferredKind::Program)
        file.calls.insert(std::to_string(reference.number));
      else if (reference.to == ReferredKind::NamedProgram)
        file.calls.insert(bareProgramName(reference.text, dialect).upper());
      else if (reference.to == ReferredKind::Subprogram)
        file.calls.insert(reference.text.upper());
      file.untold |= reference.to == ReferredKind::UntoldProgram;
    });
    for (const Word &word : block.words)
      if (const CodeIndex code = codeOf(dialect, word); code != noCode) {
        const Action action = dialect.codes[code].action;
        file.returns |= action == Action::Return;
        file.ends |= action == Action::ProgramEnd || action == Action::ProgramEndRewind;
      }
  }
  return file;
}

} // namespace

FileCalls readCallsOf(const SourceFile &file, const Dialect &dialect) {
  return callsIn(file.path(), file.text(), dialect, ReferenceReader(dialect));
}

FolderCalls readCalls(const std::string &folder, llvm::StringRef ending, const Dialect &dialect) {
  FolderCalls calls;
  const std::vector<std::string> files = programFiles(folder, ending, dialect);
  calls.all = files.size() <= mostFiles;
  uint64_t bytes = 0;
  const ReferenceReader references(dialect);
  for (const std::string &path : files) {
    uint64_t size = 0;
    if (!calls.all)
      break;
    if (!isRegularFile(path) || llvm::sys::fs::file_size(path, size) || size > longestFile)
      continue; // so long a program comes from a CAM system and calls none of one's own
    bytes += size;
    calls.all = bytes <= mostBytes;
    if (const auto buffer = llvm::MemoryBuffer::getFile(path))
      calls.files.push_back(callsIn(path, (*buffer)->getBuffer(), dialect, references));
  }
  return calls;
}

} // namespace ncvet
