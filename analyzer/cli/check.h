// `ncvet check`: lints files and folders.
#pragma once

#include "analyzer/cli/check_options.h"
#include "analyzer/cli/check_round.h"
#include "analyzer/cli/command.h"

namespace ncvet::cli {

/// Checks what is asked for and writes the reports; the exit code.
int runCheck(CheckRequest request, CheckRound *round = nullptr);

class CheckCommand final : public Command {
public:
  CheckCommand();
  int run() override;

private:
  /// What is asked for, with files that options name as they are now.
  llvm::Expected<CheckRequest> request() const;

  CheckOptions given_;
};

} // namespace ncvet::cli
