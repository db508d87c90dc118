// `ncvet lsp`: the language server on standard input and output.
#pragma once

#include "analyzer/cli/command.h"

namespace ncvet::cli {

class LspCommand final : public Command {
public:
  LspCommand();
  int run() override;

private:
  bool stdio_ = false;
};

} // namespace ncvet::cli
