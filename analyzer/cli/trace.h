// `ncvet trace`: the motions of a program, one JSON object a line.
#pragma once

#include "analyzer/cli/command.h"

namespace ncvet::cli {

class TraceCommand final : public Command {
public:
  TraceCommand();
  llvm::cl::SubCommand &subcommand() override { return command_; }
  int run() override;

private:
  llvm::cl::SubCommand command_;
  llvm::cl::OptionCategory category_;
  llvm::cl::opt<std::string> file_;
  llvm::cl::opt<std::string> dialect_, machine_, config_;
};

} // namespace ncvet::cli
