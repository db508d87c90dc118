// `ncvet explain`, `ncvet rules` and `ncvet dialects`: what there is, and what it means.
#pragma once

#include "analyzer/cli/command.h"

namespace ncvet::cli {

class ExplainCommand final : public Command {
public:
  ExplainCommand();
  llvm::cl::SubCommand &subcommand() override { return command_; }
  int run() override;

private:
  llvm::cl::SubCommand command_;
  llvm::cl::OptionCategory category_;
  llvm::cl::opt<std::string> rule_;
  llvm::cl::opt<std::string> dialect_;
};

class RulesCommand final : public Command {
public:
  RulesCommand();
  llvm::cl::SubCommand &subcommand() override { return command_; }
  int run() override;

private:
  llvm::cl::SubCommand command_;
  llvm::cl::OptionCategory category_;
  llvm::cl::opt<std::string> format_;
};

class DialectsCommand final : public Command {
public:
  DialectsCommand();
  llvm::cl::SubCommand &subcommand() override { return command_; }
  int run() override;

private:
  llvm::cl::SubCommand command_;
  llvm::cl::OptionCategory category_;
  llvm::cl::opt<std::string> check_;
};

} // namespace ncvet::cli
