// `ncvet config` and `ncvet init`: which settings count and who gave them; a configuration to begin
// with.
#pragma once

#include "analyzer/cli/command.h"
#include "analyzer/cli/setup_options.h"

namespace ncvet::cli {

class ConfigCommand final : public Command {
public:
  ConfigCommand();
  int run() override;

private:
  std::vector<std::string> path_;
  SetupOptions setup_;
  std::string profile_, format_ = "text";
};

class InitCommand final : public Command {
public:
  InitCommand();
  int run() override;

private:
  std::vector<std::string> folder_;
  std::string dialect_, machine_, profile_;
  bool force_ = false;
};

} // namespace ncvet::cli
