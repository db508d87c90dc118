// `ncvet merge`: one report of several, as the parts of a matrix make them.
#pragma once

#include "analyzer/cli/command.h"

namespace ncvet::cli {

class MergeCommand final : public Command {
public:
  MergeCommand();
  int run() override;

private:
  std::vector<std::string> files_;
  std::string output_ = "-";
};

} // namespace ncvet::cli
