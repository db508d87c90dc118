// Inputs: the files that a list of paths means.
#pragma once

#include "analyzer/setup/session.h"

namespace ncvet {

struct Input {
  std::string path;    ///< `-`: standard input
  std::string display; ///< as reports show it
  bool named = false;  ///< by the user; else found in a folder
};

struct Inputs {
  std::vector<Input> files;          ///< in the order of their names, no file twice
  std::vector<std::string> errors;   ///< one line each: paths that cannot be read
  std::vector<std::string> warnings; ///< one line each: what is probably not meant
};

struct InputChoice {
  bool followLinks = false; ///< also what symbolic links outside of the named folder lead to
  std::vector<std::string> exclude; ///< globs, relative to the current folder
  bool forceExclude = false;        ///< what is excluded is left out even where it is named
};

/// Files as they are named, folders with all programs below them: what has the ending of a program
/// and, where the ending says little, looks like one. Hidden files and folders are left out, and so
/// is what the configuration excludes. A file that several paths lead to counts once.
Inputs collectInputs(llvm::ArrayRef<std::string> paths, Session &session,
                     const InputChoice &choice = {});

/// Whether the file is a symbolic link to a place outside of `folder`.
bool leadsOut(llvm::StringRef file, llvm::StringRef folder);

} // namespace ncvet
