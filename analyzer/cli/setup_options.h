// Options that several subcommands have: the control, the machine, the configuration.
#pragma once

#include "analyzer/cli/options.h"
#include "analyzer/setup/session.h"

namespace ncvet::cli {

/// What decides how a program is read.
struct SetupOptions {
  std::string dialect = "auto";
  std::string machine, config;

  /// Declares them, in a section of their own.
  void declare(OptionSet &options);
  /// Sets them in `session`; an error when the machine profile cannot be read.
  llvm::Error apply(SessionOptions &session) const;
};

/// An error that names the nearest built-in control when `id` is none.
llvm::Error checkDialect(llvm::StringRef id);

/// The text of standard input.
llvm::Expected<std::unique_ptr<llvm::MemoryBuffer>> readStandardInput();

} // namespace ncvet::cli
