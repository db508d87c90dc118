// Programs beside ncvet that tests run: editors, npm and what it fetches.
#pragma once

#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/SmallVector.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/MemoryBuffer.h"
#include "llvm/Support/Path.h"
#include "llvm/Support/Process.h"
#include "llvm/Support/Program.h"
#include "llvm/Support/xxhash.h"
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace ncvet::test {

inline std::string contentsOf(const std::filesystem::path &path) {
  auto buffer = llvm::MemoryBuffer::getFile(path.string());
  return buffer ? (*buffer)->getBuffer().str() : std::string();
}

/// Runs a program with its output into `log`; its exit status, or -1 when it could not run or took
/// longer than `seconds`.
inline int runOuter(const std::vector<std::string> &command, const std::filesystem::path &log,
                    unsigned seconds) {
  const auto program = llvm::sys::findProgramByName(command.front());
  if (!program)
    return -1;
  std::filesystem::remove(log); // it is opened without being cut
  const std::vector<llvm::StringRef> arguments(command.begin(), command.end());
  const std::string logName = log.string();
  const llvm::Optional<llvm::StringRef> streams[] = {llvm::StringRef(), llvm::StringRef(logName),
                                                     llvm::StringRef(logName)};
  return llvm::sys::ExecuteAndWait(*program, arguments, llvm::None, streams, seconds);
}

/// A folder that outlives the tests and lies outside of the sources: what is fetched is kept there.
inline std::filesystem::path cacheFolder() {
  llvm::SmallString<256> folder;
  if (!llvm::sys::path::cache_directory(folder))
    llvm::sys::path::system_temp_directory(/*ErasedOnReboot=*/false, folder);
  return std::filesystem::path(folder.str().str()) / "ncvet-tests";
}

/// The packages of npm that the `package-lock.json` of a folder names, fetched once: a folder
/// `node_modules`. Nothing when npm is absent or cannot fetch them. Their own scripts are not run.
inline std::optional<std::filesystem::path> nodeModules(const std::filesystem::path &project) {
  namespace fs = std::filesystem;
  const std::string wanted =
      contentsOf(project / "package.json") + contentsOf(project / "package-lock.json");
  const fs::path folder = cacheFolder() / ("node-" + llvm::utohexstr(llvm::xxHash64(wanted)));
  const fs::path modules = folder / "node_modules";
  if (fs::exists(modules))
    return modules;
  // Into a folder of its own first, so that a fetch that is cut off leaves nothing half done.
  const fs::path fresh = folder.string() + "-" + std::to_string(llvm::sys::Process::getProcessId());
  std::error_code error;
  fs::create_directories(fresh, error);
  for (const char *file : {"package.json", "package-lock.json"})
    fs::copy_file(project / file, fresh / file, error);
  const int status = runOuter(
      {"npm", "ci", "--prefix", fresh.string(), "--no-audit", "--no-fund", "--ignore-scripts"},
      fresh / "npm.log", 300);
  if (status == 0)
    fs::rename(fresh, folder, error); // fails when another run was quicker, which is as good
  fs::remove_all(fresh, error);
  if (!fs::exists(modules))
    return std::nullopt;
  return modules;
}

/// What a script has said in its log: `done` at its end, and before that a line for each thing that
/// went wrong. How long its steps took is said by lines that begin with `took`, which are printed.
inline void expectDone(const std::filesystem::path &log) {
  llvm::SmallVector<llvm::StringRef, 64> lines;
  const std::string said = contentsOf(log);
  llvm::StringRef(said).split(lines, '\n', -1, /*KeepEmpty=*/false);
  EXPECT_TRUE(llvm::is_contained(lines, "done")) << said;
  for (const llvm::StringRef line : lines) {
    if (line.startswith("took "))
      std::cout << line.str() << '\n';
    else if (line != "done")
      ADD_FAILURE() << line.str();
  }
}

} // namespace ncvet::test
