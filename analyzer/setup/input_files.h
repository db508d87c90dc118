// Inputs: the files that a list of paths means.
#pragma once

#include "analyzer/setup/session.h"

namespace ncvet {

struct Input {
  std::string path;    ///< `-`: standard input
  std::string display; ///< as reports show it
};

struct Inputs {
  std::vector<Input> files;        ///< in the order of their names, none twice
  std::vector<std::string> errors; ///< one line each: paths that cannot be read
};

/// Files as they are named, folders with all programs below them: what has the ending of a program
/// and, where the ending says little, looks like one. Hidden files and folders are left out, and so
/// is what the configuration excludes.
Inputs collectInputs(llvm::ArrayRef<std::string> paths, Session &session);

} // namespace ncvet
