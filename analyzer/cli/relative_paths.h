// `--relative-to`: paths are shown as seen from another folder than the current one.
#pragma once

#include "analyzer/cli/check_options.h"

namespace ncvet::cli {

/// Makes `folder` the current folder of the process, so that all paths of a report are relative to
/// it, and changes the paths of the request so that they lead to the same files as before.
llvm::Error showRelativeTo(const std::string &folder, CheckRequest &request);

} // namespace ncvet::cli
