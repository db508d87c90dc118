// The names of a cycle's quantities and traits in the tables.
#include "formats/dialect/measure.h"

namespace ncvet {

namespace {
constexpr llvm::StringLiteral measures[] = {
    "allowance-x",    "allowance-z",   "last-cut-x",     "last-cut-z",    "spread-x",
    "spread-z",       "retract",       "height",         "first-cut",     "least-cut",
    "last-cut",       "finish-passes", "run-out",        "run-out-angle", "flank-angle",
    "constant-depth", "both-flanks",   "back",           "approach",      "top",
    "bottom",         "bottom-rest",   "first-depth",    "reduction",     "step",
    "most-step",      "chip-break",    "dwell",          "dwell-top",     "centre-first",
    "centre-second",  "length",        "width",          "radius",        "rounding",
    "angle",          "side-rest",     "count",          "direction",     "island",
    "feed-down",      "feed-along",    "first-distance", "last-distance", "pockets",
    "across",         "lead",          "inside"};
static_assert(std::size(measures) == size_t(Measure::Inside) + 1);

constexpr llvm::StringLiteral traits[] = {"follows-contour", "returns-by-axes", "ignores-corners",
                                          "wants-hole",      "starts-here",     "turned",
                                          "turns-contour",   "keeps-words"};
static_assert(std::size(traits) == size_t(CycleTrait::KeepsWords) + 1);
} // namespace

llvm::ArrayRef<llvm::StringLiteral> measureNames() { return measures; }
llvm::ArrayRef<llvm::StringLiteral> cycleTraitNames() { return traits; }

} // namespace ncvet
