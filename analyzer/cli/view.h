// `ncvet view`: programs as a page with findings and tool paths, in the browser.
#pragma once

#include "analyzer/cli/command.h"
#include "analyzer/cli/setup_options.h"

namespace ncvet::cli {

class ViewCommand final : public Command {
public:
  ViewCommand();
  int run() override;

private:
  std::vector<std::string> paths_;
  SetupOptions setup_;
  std::string output_;
  bool noOpen_ = false;
};

} // namespace ncvet::cli
