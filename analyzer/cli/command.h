// What the subcommands share: exit codes, and one line on standard error for what went wrong.
#pragma once

#include "llvm/ADT/StringRef.h"
#include "llvm/ADT/Twine.h"
#include "llvm/Support/CommandLine.h"

#include <string>

namespace ncvet::cli {

constexpr int exitClean = 0;
constexpr int exitFindings = 1;
constexpr int exitFailure = 2; ///< wrong usage, or what cannot be read or written

/// `ncvet: error: MESSAGE` on standard error; returns `exitFailure`.
int fail(const llvm::Twine &message);

/// A subcommand with its options. Objects are made before the command line is parsed and live until
/// the end of the run.
class Command {
public:
  virtual ~Command() = default;
  virtual llvm::cl::SubCommand &subcommand() = 0;
  virtual int run() = 0;
};

} // namespace ncvet::cli
