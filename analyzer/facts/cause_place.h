// Where the cause of a finding is written: in the file of the current block, or in that of a caller
// or of a called program.
#pragma once

#include "analyzer/rule/rule.h"

#include <string>

namespace ncvet {

/// A cause that is reported where it is written, in the file that is looked at. In another file it
/// may be right for other programs: then it is reported at its effect, with a note at the cause.
struct CausePlace {
  SourceRange at;    ///< to report it at
  SourceRange other; ///< for the note: the effect, or the cause
  bool isCause = true;
  std::string where; ///< of the cause, in words: "here", "in line 3 of O0020.nc"

  /// Text of the note.
  const char *note(const char *atEffect, const char *atCause) const {
    return isCause ? atEffect : atCause;
  }
};

/// The place of a known cause whose effect is in the current block, at `effect`.
CausePlace causePlace(const RuleContext &ctx, const Origin &cause, SourceRange effect);
inline CausePlace causePlace(const RuleContext &ctx, const Origin &cause) {
  return causePlace(ctx, cause, ctx.blockRange());
}

/// Whether it was set in the file of the current block.
inline bool isHere(const RuleContext &ctx, const Origin &origin) {
  return origin.known() && origin.file == ctx.source().id();
}
/// Whether it was set in `program`, one of the current block's file.
inline bool isIn(const RuleContext &ctx, const Origin &origin, const ProgramInfo &program) {
  return isHere(ctx, origin) && origin.begin >= program.begin && origin.begin < program.end;
}

/// Line of a place, from 1, for messages: "12", or "12 of O0020.nc".
std::string lineOf(const RuleContext &ctx, const Origin &origin);
/// Reads the block in which it was set, in whichever file that is.
void readBlockOf(const RuleContext &ctx, const Origin &origin, Block &block);

} // namespace ncvet
