// `ncvet trace`: the motions of a program, one JSON object a line.
#pragma once

#include "analyzer/cli/command.h"
#include "analyzer/cli/setup_options.h"

namespace ncvet::cli {

class TraceCommand final : public Command {
public:
  TraceCommand();
  int run() override;

private:
  llvm::Expected<const SourceFile *> open(SourceSet &sources) const;

  std::vector<std::string> file_;
  SetupOptions setup_;
  std::string stdinFilename_;
};

} // namespace ncvet::cli
