// Who calls a program: blocks of its own file, and of the files round it.
#pragma once

#include "analyzer/program/folder_calls.h"
#include "analyzer/program/project.h"

namespace ncvet {

/// A block that calls a program.
struct CallPlace {
  FileUnit *unit;
  uint32_t block; ///< its offset
  bool once;      ///< it runs the program one time
};

struct Callers {
  std::vector<CallPlace> places;
  bool all = true; ///< false: there may be others, which the texts do not tell
};

/// Who calls `program`, a program of `unit`: in its file, in the files of its folder, of those that
/// are searched for every file, and of those of the files that are checked together. Of a folder
/// for subprograms (`subs`) the one above counts too, of one of a control's archive (`SPF.DIR`)
/// those beside it as well.
Callers callersOf(FileUnit &unit, const ProgramInfo &program);
/// The same without the calls in its own file.
Callers callersInOtherFiles(FileUnit &unit, const ProgramInfo &program);

/// The files beside `unit` that only return to a caller, and that no file there calls. Nothing
/// where the texts do not tell it.
std::vector<std::string> uncalledFilesBeside(FileUnit &unit);

} // namespace ncvet
