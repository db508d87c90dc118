// The lists of a tool path: cut at a move, and put together again with what has become of the rest.
#pragma once

#include "formats/finding/tool_path.h"

namespace ncvet {

/// How many elements each list has, as `first`.
ToolPathChange lengthsOf(const ToolPath &path);

/// Moves and operations of blocks after the edit get their lines.
void moveLines(ToolPath &path, const ToolPathChange &change);

/// The end of a path, which is taken away to be made anew.
class CutPath {
public:
  /// Takes what comes after the lengths that `first` of each list of `from` gives.
  CutPath(ToolPath &path, const ToolPathChange &from);

  /// The path, made anew up to where it is as it was at the lengths `met`, gets the rest of what
  /// was taken. `change` gets what is another now; its lines say where blocks have gone.
  void append(const ToolPathChange &met, ToolPathChange &change);
  /// All was made anew: `change` gets what is another now.
  void compare(ToolPathChange &change) const;

private:
  template <typename List, typename Same>
  static void trim(const List &old, size_t oldCount, const List &made, ListChange &list,
                   const Same &same);
  void trimAll(const ToolPathChange &oldLengths, ToolPathChange &change) const;

  ToolPath &path_;
  const ToolPathChange from_;
  ToolPath rest_;
};

} // namespace ncvet
