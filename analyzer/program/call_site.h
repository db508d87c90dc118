// Where a program that is being executed was called.
#pragma once

#include <cstdint>

namespace ncvet {

struct FileUnit;
struct ProgramInfo;

/// The call that runs a program; a list up to the main program. Lives while the program runs.
struct CallSite {
  FileUnit *unit = nullptr; ///< of the caller; null: something calls it, nobody knows what
  const ProgramInfo *program = nullptr; ///< the calling one
  uint32_t next = 0;                    ///< block at which the caller goes on
  bool once = false;                    ///< it runs one time before that
  const CallSite *before = nullptr; ///< where the caller was called; null: it is the main program
  bool macro = false;               ///< with variables of its own
  unsigned depth = before ? before->depth + 1 : 1; ///< of calls, with this one
};

} // namespace ncvet
