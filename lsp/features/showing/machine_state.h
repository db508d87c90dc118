// The machine's state at a block, in words.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/text/source_set.h"

#include <string>

namespace ncvet {
struct StatesAt; // analyzer/flow/observed_block.h
}

namespace ncvet::lsp {

/// Markdown: modal codes, position, tool, offsets, feed, speed, compensation and cycle before the
/// block that the states are of, as sets where paths differ, and the calls that lead there. Empty
/// when no path leads there. `sources`: the files in which the paths lie.
std::string machineState(const Dialect &dialect, const StatesAt &states, const SourceSet &sources);

} // namespace ncvet::lsp
