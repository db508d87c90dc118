// `ncvet check`: lints files and folders.
#pragma once

#include "analyzer/cli/check_options.h"

namespace ncvet::cli {

class CheckCommand final : public Command {
public:
  llvm::cl::SubCommand &subcommand() override { return options_.command; }
  int run() override;

private:
  CheckOptions options_;
};

} // namespace ncvet::cli
