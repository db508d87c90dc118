// The closed vocabulary of what a code does; each action is implemented once, in interp/.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"

#include <cstdint>
#include <optional>

namespace ncvet {

/// name, spelling in the tables
#define NCVET_ACTIONS(X)                                                                           \
  X(None, "none")                                                                                  \
  X(Rapid, "rapid")                                                                                \
  X(Linear, "linear")                                                                              \
  X(ArcCw, "arc-cw")                                                                               \
  X(ArcCcw, "arc-ccw")                                                                             \
  X(Thread, "thread")                                                                              \
  X(CurveFeed, "curve")                                                                            \
  X(CurveThrough, "curve-through")                                                                 \
  X(CurveTangent, "curve-tangent")                                                                 \
  X(CurvePoint, "curve-point")                                                                     \
  X(CurveEnd, "curve-end")                                                                         \
  X(Dwell, "dwell")                                                                                \
  X(ExactStop, "exact-stop")                                                                       \
  X(PathMode, "path-mode")                                                                         \
  X(DataInput, "data-input")                                                                       \
  X(DataInputEnd, "data-input-end")                                                                \
  X(PlaneXY, "plane-xy")                                                                           \
  X(PlaneZX, "plane-zx")                                                                           \
  X(PlaneYZ, "plane-yz")                                                                           \
  X(Inch, "inch")                                                                                  \
  X(Metric, "metric")                                                                              \
  X(ReferenceReturn, "reference-return")                                                           \
  X(ReferenceCheck, "reference-check")                                                             \
  X(ReferenceFrom, "reference-from")                                                               \
  X(SkipMove, "skip-move")                                                                         \
  X(CompensationOff, "compensation-off")                                                           \
  X(CompensationLeft, "compensation-left")                                                         \
  X(CompensationRight, "compensation-right")                                                       \
  X(CompensationKeep, "compensation-keep")                                                         \
  X(CompensationCorner, "compensation-corner")                                                     \
  X(SoftApproach, "soft-approach")                                                                 \
  X(SoftRetract, "soft-retract")                                                                   \
  X(LengthPositive, "length-positive")                                                             \
  X(LengthNegative, "length-negative")                                                             \
  X(LengthOff, "length-off")                                                                       \
  X(LengthSet, "length-set")                                                                       \
  X(LengthAdd, "length-add")                                                                       \
  X(SpeedLimit, "speed-limit")                                                                     \
  X(LocalShift, "local-shift")                                                                     \
  X(PresetPosition, "preset-position")                                                             \
  X(PresetClear, "preset-clear")                                                                   \
  X(PresetSuspend, "preset-suspend")                                                               \
  X(PresetRestore, "preset-restore")                                                               \
  X(ZeroSet, "zero-set")                                                                           \
  X(ZeroHere, "zero-here")                                                                         \
  X(StorePlace, "store-place")                                                                     \
  X(DiameterOn, "diameter-on")                                                                     \
  X(DiameterAbsolute, "diameter-absolute")                                                         \
  X(DiameterOff, "diameter-off")                                                                   \
  X(MachineMove, "machine-move")                                                                   \
  X(WorkOffset, "work-offset")                                                                     \
  X(Absolute, "absolute")                                                                          \
  X(Incremental, "incremental")                                                                    \
  X(ArcAbsolute, "arc-absolute")                                                                   \
  X(ArcIncremental, "arc-incremental")                                                             \
  X(FeedPerMinute, "feed-per-minute")                                                              \
  X(FeedPerRevolution, "feed-per-revolution")                                                      \
  X(FeedInverseTime, "feed-inverse-time")                                                          \
  X(SurfaceSpeed, "surface-speed")                                                                 \
  X(ConstantSpeed, "constant-speed")                                                               \
  X(ReturnInitial, "return-initial")                                                               \
  X(ReturnR, "return-r")                                                                           \
  X(PolarOn, "polar-on")                                                                           \
  X(PolarOff, "polar-off")                                                                         \
  X(RotationOn, "rotation-on")                                                                     \
  X(RotationOff, "rotation-off")                                                                   \
  X(ScalingOn, "scaling-on")                                                                       \
  X(ScalingOff, "scaling-off")                                                                     \
  X(MirrorOn, "mirror-on")                                                                         \
  X(MirrorOff, "mirror-off")                                                                       \
  X(FrameSet, "frame-set")                                                                         \
  X(FrameAdd, "frame-add")                                                                         \
  X(FrameClear, "frame-clear")                                                                     \
  X(Reset, "reset")                                                                                \
  X(ProfileBegin, "profile-begin")                                                                 \
  X(ProfileRun, "profile-run")                                                                     \
  X(Pole, "pole")                                                                                  \
  X(PoleFromPlace, "pole-from-place")                                                              \
  X(PoleFromPole, "pole-from-pole")                                                                \
  X(PolygonOn, "polygon-on")                                                                       \
  X(PolygonOff, "polygon-off")                                                                     \
  X(ZoneOn, "zone-on")                                                                             \
  X(ZoneOff, "zone-off")                                                                           \
  X(LookAheadLimit, "look-ahead-limit")                                                            \
  X(Cycle, "cycle")                                                                                \
  X(CycleCancel, "cycle-cancel")                                                                   \
  X(MacroCall, "macro-call")                                                                       \
  X(MacroModal, "macro-modal")                                                                     \
  X(MacroCancel, "macro-cancel")                                                                   \
  X(ProgramStop, "program-stop")                                                                   \
  X(OptionalStop, "optional-stop")                                                                 \
  X(ProgramEnd, "program-end")                                                                     \
  X(ProgramEndRewind, "program-end-rewind")                                                        \
  X(SpindleCw, "spindle-cw")                                                                       \
  X(SpindleCcw, "spindle-ccw")                                                                     \
  X(SpindleStop, "spindle-stop")                                                                   \
  X(SpindleOrient, "spindle-orient")                                                               \
  X(LiveToolCw, "live-tool-cw")                                                                    \
  X(LiveToolCcw, "live-tool-ccw")                                                                  \
  X(LiveToolStop, "live-tool-stop")                                                                \
  X(ToolChange, "tool-change")                                                                     \
  X(SetTool, "set-tool")                                                                           \
  X(CoolantOn, "coolant-on")                                                                       \
  X(CoolantOff, "coolant-off")                                                                     \
  X(Clamp, "clamp")                                                                                \
  X(Unclamp, "unclamp")                                                                            \
  X(ChuckClose, "chuck-close")                                                                     \
  X(ChuckOpen, "chuck-open")                                                                       \
  X(AxisEngage, "axis-engage")                                                                     \
  X(AxisRelease, "axis-release")                                                                   \
  X(Switch, "switch")                                                                              \
  X(CallProgram, "call-program")                                                                   \
  X(CallLocal, "call-local")                                                                       \
  X(Return, "return")                                                                              \
  X(Jump, "jump")                                                                                  \
  X(ConditionalJump, "conditional-jump")                                                           \
  X(ProgramHead, "program-head")                                                                   \
  X(Sleep, "sleep")                                                                                \
  X(SkipCheck, "skip-check")                                                                       \
  X(DefineElement, "define-element")                                                               \
  X(ModesKept, "modes-kept")                                                                       \
  X(ModesForgotten, "modes-forgotten")                                                             \
  X(ModesRestored, "modes-restored")                                                               \
  X(ModesRestoredAtReturn, "modes-restored-at-return")                                             \
  X(MachineSpecific, "machine-specific")

enum class Action : uint8_t {
#define X(name, text) name,
  NCVET_ACTIONS(X)
#undef X
};

/// All spellings, in the order of the enumeration.
llvm::ArrayRef<llvm::StringLiteral> actionNames();

/// True for actions that move axes and stay in force: G00, G01, G02, G03, threads.
constexpr bool isMotion(Action action) {
  return action == Action::Rapid || action == Action::Linear || action == Action::ArcCw ||
         action == Action::ArcCcw || action == Action::Thread || action == Action::CurveFeed ||
         action == Action::CurveThrough || action == Action::CurveTangent ||
         action == Action::CurvePoint;
}
/// True for actions whose words name where the control goes: calls, jumps and returns.
constexpr bool namesTarget(Action action) {
  return action == Action::CallProgram || action == Action::CallLocal ||
         action == Action::MacroCall || action == Action::MacroModal ||
         action == Action::ConditionalJump || action == Action::Return;
}
constexpr bool isArc(Action action) { return action == Action::ArcCw || action == Action::ArcCcw; }

} // namespace ncvet
