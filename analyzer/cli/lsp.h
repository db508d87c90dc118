// `ncvet lsp`: the language server on standard input and output.
#pragma once

#include "analyzer/cli/command.h"

namespace ncvet::cli {

class LspCommand final : public Command {
public:
  LspCommand();
  llvm::cl::SubCommand &subcommand() override { return command_; }
  int run() override;

private:
  llvm::cl::SubCommand command_;
  llvm::cl::OptionCategory category_;
  llvm::cl::opt<bool> stdio_;
};

} // namespace ncvet::cli
