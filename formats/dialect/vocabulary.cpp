// The words that tables may use for roles, cycles, kinds and groups.
#include "formats/dialect/vocabulary.h"

namespace ncvet {

namespace {
constexpr llvm::StringLiteral roles[] = {
    "none",        "target",        "depth",        "retract",     "dwell",          "time",
    "peck",        "peck-first",    "peck-step",    "peck-least",  "peck-clearance", "repeat",
    "lead",        "profile-first", "profile-last", "allowance-x", "allowance-z",    "cut-depth",
    "pass-count",  "stock-x",       "stock-z",      "height",      "first-cut",      "least-cut",
    "thread-form", "angle",         "taper",        "shift",       "program",        "sequence",
    "speed",       "feed",          "step",         "centre",      "radius",         "offset",
    "ratio",       "method",        "limit",        "argument",    "start-angle",    "relief",
    "counterbore"};
static_assert(std::size(roles) == size_t(Role::Counterbore) + 1);

constexpr llvm::StringLiteral frames[] = {"none",   "shift",  "rotation",    "scale",
                                          "mirror", "offset", "mirror-axes", "steps"};
static_assert(std::size(frames) == size_t(FrameKind::Steps) + 1);

constexpr llvm::StringLiteral cycles[] = {"none",           "drill",
                                          "drill-dwell",    "peck",
                                          "chip-break",     "tap",
                                          "tap-left",       "rigid-tap",
                                          "rigid-tap-left", "ream",
                                          "ream-dwell",     "bore-stop",
                                          "bore-manual",    "bore-dwell-manual",
                                          "fine-bore",      "back-bore",
                                          "turn-pass",      "face-pass",
                                          "thread-pass",    "rough-turn",
                                          "rough-face",     "pattern-repeat",
                                          "finish",         "groove-face",
                                          "groove-radial",  "thread-multi",
                                          "pattern",        "face",
                                          "contour",        "pocket",
                                          "slot",           "thread-mill",
                                          "measure",        "thread-infeed",
                                          "surface",        "thread-chain"};
static_assert(std::size(cycles) == size_t(CycleKind::ThreadChain) + 1);

constexpr llvm::StringLiteral needs[] = {"optional", "required", "first", "here"};
constexpr llvm::StringLiteral points[] = {"any", "required", "forbidden"};
constexpr llvm::StringLiteral spindles[] = {"any", "running", "clockwise", "counter-clockwise",
                                            "starts-itself"};
// "unknown" is what an absent entry means; a table does not write it.
constexpr llvm::StringLiteral kinds[] = {"unknown", "axis", "increment", "polar",
                                         "element", "code", "parameter", "number"};
constexpr llvm::StringLiteral namings[] = {"none", "define", "use", "drop"};
constexpr llvm::StringLiteral units[] = {"none",  "length", "angle", "feed",
                                         "speed", "time",   "whole"};
constexpr llvm::StringLiteral arcWords[] = {"radius", "angle", "through-x", "through-y",
                                            "through-z"};
constexpr llvm::StringLiteral addressActions[] = {"speed-limit", "spindle-orient", "feed",
                                                  "block-feed"};
constexpr llvm::StringLiteral codeNeeds[] = {"feed", "speed"};
constexpr llvm::StringLiteral axes[] = {"X", "Y", "Z", "A", "B", "C", "U", "V", "W"};
static_assert(std::size(axes) == axisCount);
constexpr llvm::StringLiteral machines[] = {"lathe", "mill"};
constexpr llvm::StringLiteral semicolons[] = {"comment", "end-of-block"};
constexpr llvm::StringLiteral arithmetics[] = {"macro-b", "macro-b-30i", "macro-b-decimal", "ngc"};
constexpr llvm::StringLiteral severities[] = {"style", "warning", "error"};
constexpr llvm::StringLiteral groups[] = {
    "motion",       "plane",         "units",   "distance",     "feed-mode",   "speed-mode",
    "compensation", "length-offset", "cycle",   "return-level", "work-offset", "path-mode",
    "polar",        "rotation",      "scaling", "mirror",       "macro-modal", "language",
    "arc-distance", "diameter",      "spindle", "coolant",      "program"};
static_assert(std::size(groups) == size_t(StandardGroup::Count));
} // namespace

llvm::ArrayRef<llvm::StringLiteral> roleNames() { return roles; }
llvm::ArrayRef<llvm::StringLiteral> cycleNames() { return cycles; }
llvm::ArrayRef<llvm::StringLiteral> frameNames() { return frames; }
llvm::ArrayRef<llvm::StringLiteral> needNames() { return needs; }
llvm::ArrayRef<llvm::StringLiteral> namingNames() { return namings; }
llvm::ArrayRef<llvm::StringLiteral> pointNames() { return points; }
llvm::ArrayRef<llvm::StringLiteral> spindleNames() { return spindles; }
llvm::ArrayRef<llvm::StringLiteral> addressKindNames() { return kinds; }
llvm::ArrayRef<llvm::StringLiteral> addressUnitNames() { return units; }
llvm::ArrayRef<llvm::StringLiteral> arcWordNames() { return arcWords; }
llvm::ArrayRef<llvm::StringLiteral> addressActionNames() { return addressActions; }
llvm::ArrayRef<llvm::StringLiteral> codeNeedNames() { return codeNeeds; }
llvm::ArrayRef<llvm::StringLiteral> axisNames() { return axes; }
llvm::ArrayRef<llvm::StringLiteral> machineNames() { return machines; }
llvm::ArrayRef<llvm::StringLiteral> semicolonNames() { return semicolons; }
llvm::ArrayRef<llvm::StringLiteral> arithmeticNames() { return arithmetics; }
llvm::ArrayRef<llvm::StringLiteral> severityNames() { return severities; }
llvm::ArrayRef<llvm::StringLiteral> standardGroupNames() { return groups; }

llvm::StringRef toString(Role role) { return roles[unsigned(role)]; }
llvm::StringRef toString(StandardGroup group) { return groups[unsigned(group)]; }

} // namespace ncvet
