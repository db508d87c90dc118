// A program with another name, in all files that name it.
#pragma once

#include "formats/text/edit.h"
#include "lsp/features/names.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

struct ProgramRename {
  std::vector<TextEdit> edits; ///< of files of the snapshot's project
  std::string from, to; ///< path of the file that is named after the program, and its new one
  std::string refused;  ///< why there are none, one line
};

/// The program or subprogram whose name is at the byte `offset`, as it is called there or defined,
/// gets another one: in its own file, in its callers among the files at `paths`, and as the name of
/// its file. Refused where a call in one of them names a program that only the run decides, and
/// where the new name is one that is there already.
ProgramRename renameProgram(Snapshot &snapshot, uint32_t offset, llvm::StringRef name,
                            llvm::ArrayRef<std::string> paths);

/// The same for the document itself, whose file gets the name of the path `to`. No edits where the
/// file is not named after a program, or stays so.
ProgramRename renameWithFile(Snapshot &snapshot, llvm::StringRef to,
                             llvm::ArrayRef<std::string> paths);

} // namespace ncvet::lsp
