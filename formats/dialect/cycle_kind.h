// The kinds of canned and turning cycles, and the families that are asked for by one word.
#pragma once

#include <cstdint>

namespace ncvet {

/// Canned and turning cycles, by the motions that they make.
enum class CycleKind : uint8_t {
  None,
  Drill,
  DrillDwell,
  Peck,
  ChipBreak,
  Tap,
  TapLeft,
  RigidTap,
  RigidTapLeft,
  Ream,
  ReamDwell,
  BoreStop,
  BoreManual,
  BoreDwellManual,
  FineBore,
  BackBore,
  TurnPass,
  FacePass,
  ThreadPass,
  RoughTurn,
  RoughFace,
  PatternRepeat,
  Finish,
  GrooveFace,
  GrooveRadial,
  ThreadMulti,
  Pattern, ///< moves from place to place; the active modal cycle runs at each
  Face,    ///< mills a face
  Contour, ///< mills along a contour
  Pocket,
  Slot,
  ThreadMill,
  Measure,      ///< touches the work
  ThreadInfeed, ///< threads pass by pass beside a line along Z, each deeper than the one before
  Surface,      ///< mills a surface: at each place at another depth
  ThreadChain   ///< threads from place to place, pass by pass
};

/// Taps by a spindle that is coupled to the feed.
constexpr bool tapsRigidly(CycleKind kind) {
  return kind == CycleKind::RigidTap || kind == CycleKind::RigidTapLeft;
}
constexpr bool taps(CycleKind kind) {
  return kind == CycleKind::Tap || kind == CycleKind::TapLeft || tapsRigidly(kind);
}
/// Widens a hole that is there.
constexpr bool bores(CycleKind kind) {
  return kind == CycleKind::Ream || kind == CycleKind::ReamDwell || kind == CycleKind::BoreStop ||
         kind == CycleKind::BoreManual || kind == CycleKind::BoreDwellManual ||
         kind == CycleKind::FineBore || kind == CycleKind::BackBore;
}
/// Makes a hole along the tool's axis, or works in one.
constexpr bool makesHole(CycleKind kind) {
  return kind == CycleKind::Drill || kind == CycleKind::DrillDwell || kind == CycleKind::Peck ||
         kind == CycleKind::ChipBreak || taps(kind) || bores(kind);
}
/// Cuts a thread by turning.
constexpr bool cutsThread(CycleKind kind) {
  return kind == CycleKind::ThreadPass || kind == CycleKind::ThreadMulti;
}
/// Roughs a profile by turning, along it or across.
constexpr bool roughsProfile(CycleKind kind) {
  return kind == CycleKind::RoughTurn || kind == CycleKind::RoughFace ||
         kind == CycleKind::PatternRepeat;
}
/// Roughs a profile, or finishes it.
constexpr bool turnsProfile(CycleKind kind) {
  return roughsProfile(kind) || kind == CycleKind::Finish;
}
/// Turns or faces, in one pass or along a profile.
constexpr bool turnsOrFaces(CycleKind kind) {
  return kind == CycleKind::TurnPass || kind == CycleKind::FacePass || turnsProfile(kind);
}

} // namespace ncvet
