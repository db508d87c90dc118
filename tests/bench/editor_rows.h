// Rows of the editor's table that are no kinds of edits.
#pragma once

#include <string>

namespace ncvet::bench {

/// What the rows are made with.
struct Bench {
  std::string binary;
  std::string folder;
  unsigned edits = 0;
};

/// Code actions at each move of the cursor, and at a finding after an edit.
bool measureLightbulb(const Bench &bench);
/// Random edits: what the server's memory becomes, and whether a fresh check finds the same.
bool measureManyEdits(const Bench &bench);
/// A workspace of 2,000 programs: findings of the one that is open, of all, and memory.
bool measureWorkspace(const Bench &bench);
/// The drawing of a million moves while it turns, in Chromium.
bool measureFrames(const Bench &bench);

} // namespace ncvet::bench
