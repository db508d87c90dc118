// Runs the real binary as a process, in a folder of its own.
#pragma once

#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include "llvm/Support/MemoryBuffer.h"
#include "llvm/Support/Program.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ncvet::test {

struct ProcessResult {
  int exitCode = -1;
  std::string out, err;
};

/// A folder with files, in which ncvet runs.
class Shop {
public:
  Shop &file(const std::string &name, const std::string &text) {
    const auto path = folder_.path() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return *this;
  }

  std::string text(const std::string &name) const {
    std::ifstream in(folder_.path() / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const std::filesystem::path &path() const { return folder_.path(); }
  /// Another binary than ncvet itself.
  void binary(std::string binary) { binary_ = std::move(binary); }

  /// A variable of the environment for all runs: `NAME=VALUE`.
  Shop &environment(std::string assignment) {
    environment_.push_back(std::move(assignment));
    return *this;
  }

  /// `ncvet ARGUMENTS` with the folder as the present one. Not bounded by more than a minute.
  ProcessResult run(const std::vector<std::string> &arguments,
                    const std::string &standardInput = {}) const {
    const std::string out = (logs_.path() / "out").string();
    std::filesystem::remove(out); // it is opened without being cut
    return runInto(out, arguments, standardInput);
  }

  /// The same with standard output in a file of the caller's, `/dev/full` for one.
  ProcessResult runInto(const std::string &out, const std::vector<std::string> &arguments,
                        const std::string &standardInput = {}) const {
    const std::string in = (logs_.path() / "in").string(), err = (logs_.path() / "err").string();
    std::ofstream(in, std::ios::binary) << standardInput;
    std::filesystem::remove(err);
    // What earlier runs found is kept for this folder alone.
    const std::string cache = "NCVET_CACHE_DIR=" + (logs_.path() / "cache").string();
    std::vector<llvm::StringRef> words = {"env", "-C", folderName_, cache, "NCVET_NO_CACHE=0"};
    words.insert(words.end(), environment_.begin(), environment_.end());
    words.emplace_back(binary_);
    words.insert(words.end(), arguments.begin(), arguments.end());
    const llvm::Optional<llvm::StringRef> streams[] = {llvm::StringRef(in), llvm::StringRef(out),
                                                       llvm::StringRef(err)};
    ProcessResult result;
    result.exitCode = llvm::sys::ExecuteAndWait(*llvm::sys::findProgramByName("env"), words,
                                                llvm::None, streams, 60);
    if (out.rfind("/dev/", 0) != 0)
      result.out = contents(out);
    result.err = contents(err);
    return result;
  }

  /// Findings of `ncvet check --format json ARGUMENTS`: "path:line rule", in their order.
  std::vector<std::string> findings(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"check", "--format", "json"});
    const ProcessResult result = run(arguments);
    std::vector<std::string> list;
    const auto json = nlohmann::json::parse(result.out, nullptr, false);
    EXPECT_TRUE(json.is_object()) << result.out << result.err;
    if (json.is_object())
      for (const auto &finding : json["findings"])
        list.push_back(finding["path"].get<std::string>() + ":" +
                       std::to_string(finding["line"].get<int>()) + " " +
                       finding["rule"].get<std::string>());
    return list;
  }

private:
  static std::string contents(const std::string &path) {
    auto buffer = llvm::MemoryBuffer::getFile(path);
    return buffer ? (*buffer)->getBuffer().str() : std::string();
  }

  TemporaryFolder folder_, logs_;
  std::string folderName_ = folder_.path().string();
  std::string binary_ = places::program();
  std::vector<std::string> environment_;
};

/// Cuts without a feed in line 4, and nothing else that any dialect minds.
inline std::string programWithoutFeed() {
  return "O0001 (SHAFT)\n"
         "T101\n"
         "G97 S800 M03\n"
         "G01 X20. Z-5.\n"
         "G00 X100. Z100. M05\n"
         "M30\n";
}

} // namespace ncvet::test
