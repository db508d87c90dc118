// `ncvet dap`: the debug adapter on standard input and output.
#pragma once

#include "analyzer/cli/command.h"

namespace ncvet::cli {

class DapCommand final : public Command {
public:
  DapCommand();
  int run() override;

private:
  bool stdio_ = false;
};

} // namespace ncvet::cli
