// What a report that shows whole programs knows of one of them beside its findings.
#pragma once

#include "formats/finding/tool_path.h"

namespace ncvet {

/// A piece of a text and what it is: index in `Report::colourNames`.
struct TextColour {
  uint32_t begin = 0, end = 0; ///< bytes; never over the end of a line
  uint8_t name = 0;
  bool definition = false;
};

struct ProgramView {
  FileId file = 0;
  std::vector<TextColour> colours; ///< ascending, none over another; empty: no colours
  std::optional<ToolPath> path;
};

} // namespace ncvet
