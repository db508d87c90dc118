// What the subcommands share: options, exit codes, and one line on standard error for what went
// wrong.
#pragma once

#include "analyzer/cli/options.h"

#include "llvm/ADT/Twine.h"

namespace ncvet::cli {

constexpr int exitClean = 0;
constexpr int exitFindings = 1;
constexpr int exitFailure = 2; ///< wrong usage, or what cannot be read or written

/// `ncvet: error: MESSAGE` on standard error; returns `exitFailure`.
int fail(const llvm::Twine &message);
/// The same with the text of the error.
int fail(llvm::Error error);

/// A subcommand with its options. Standard output is flushed, and looked at for errors, after it
/// has run.
class Command {
public:
  Command(llvm::StringRef name, llvm::StringRef summary) : options(name, summary) {}
  virtual ~Command() = default;
  Command(const Command &) = delete;
  virtual int run() = 0;

  OptionSet options;
};

} // namespace ncvet::cli
