// Inlay hints: what a program does not spell out, shown beside its words.
#pragma once

#include "lsp/features/snapshot.h"

#include <atomic>

namespace ncvet {
struct MachineState; // interp/state/state.h
}

namespace ncvet::lsp {

enum class HintKind : uint8_t {
  Value,    ///< of a number whose unit its spelling decides: ` 2 ms` after `P2`
  Variable, ///< value of an expression: ` = 12.5` after `X#100`
  Target,   ///< where a computed jump or call leads: ` → N20`
  Motion,   ///< the code that is in force for a bare `X10`: `G01 ` before it
  Count
};

/// Which hints are wanted. The motions are in most blocks of a program, which is why they are
/// off.
struct HintOptions {
  std::array<bool, size_t(HintKind::Count)> on{true, true, true, false};
};

struct InlayHint {
  uint32_t offset = 0; ///< byte before which it is shown
  HintKind kind = HintKind::Value;
  std::string text;
};

/// The hints in [begin, end), ascending. Only what holds in every pass along the one path that the
/// program certainly takes; block skip off. `cancel`, when given, ends the work early.
std::vector<InlayHint> inlayHints(Snapshot &snapshot, uint32_t begin, uint32_t end,
                                  const HintOptions &options = {},
                                  const std::atomic<bool> *cancel = nullptr);

/// Where the code was set that moves the axes in this state; none: it is not certain which it is.
std::optional<SourceRange> placeOfMotion(const Dialect &dialect, const MachineState &state);

} // namespace ncvet::lsp
