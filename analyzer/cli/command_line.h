// The command line of ncvet.
#pragma once

#include "analyzer/cli/command.h"

namespace ncvet::cli {

/// Runs ncvet; returns its exit code.
int runCommandLine(int argc, const char *const *argv);

} // namespace ncvet::cli
