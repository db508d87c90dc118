// What each action does, and when: the one place where these facts are told.
#include "interp/execute/execution.h"

#include <array>

namespace ncvet {

/// Whether an action takes the block's axis words, so that they are no motion.
enum class AxisWords : uint8_t {
  Left,
  TakenInBlock, ///< by codes that do not stay in force
  Taken
};

/// What an action does in its phase.
using Effect = void (*)(Execution &, const CodeUse &);
/// What an action does with the axis words that it takes; false: the block moves all the same.
using AxisEffect = bool (*)(Execution &, const CodeUse &, uint16_t axes);

struct ActionRow {
  Action action = Action::None;
  Phase phase = Phase::None;
  Effect effect = nullptr;
  EventKind event = EventKind::Count; ///< told before the effect, with its code; Count: none
  AxisWords axisWords = AxisWords::Left;
  AxisEffect axisEffect = nullptr; ///< null: words that are taken say nothing more
};

/// The rows of all actions; those without a row are facts that others ask for.
struct Execution::Actions {
  using Member = void (Execution::*)(const CodeUse &);
  using AxisMember = bool (Execution::*)(const CodeUse &, uint16_t);

  template <Member member>
  static void does(Execution &block, const CodeUse &use) {
    (block.*member)(use);
  }
  template <uint8_t direction>
  static void turns(Execution &block, const CodeUse &use) {
    block.setSpindle(direction, use);
  }
  template <uint8_t direction>
  static void turnsLiveTool(Execution &block, const CodeUse &) {
    block.state_.liveTool = direction;
    if (direction & (spindleCw | spindleCcw)) // what cuts from here on is driven
      block.state_.clear(Fact::SpindleStoppedByTap);
  }
  template <Fact fact>
  static void sets(Execution &block, const CodeUse &) {
    block.state_.set(fact);
  }
  template <Fact fact>
  static void clears(Execution &block, const CodeUse &) {
    block.state_.clear(fact);
  }
  /// The action uses the axis words up.
  template <Member member>
  static bool uses(Execution &block, const CodeUse &use, uint16_t) {
    (block.*member)(use);
    return true;
  }
  /// The action says itself whether the block moves all the same.
  template <AxisMember member>
  static bool may(Execution &block, const CodeUse &use, uint16_t axes) {
    return (block.*member)(use, axes);
  }

  static constexpr EventKind silent = EventKind::Count;
  static constexpr ActionRow list[] = {
      {Action::Rapid, Phase::Modes, does<&Execution::takeMotion>},
      {Action::Linear, Phase::Modes, does<&Execution::takeMotion>},
      {Action::ArcCw, Phase::Modes, does<&Execution::takeMotion>},
      {Action::ArcCcw, Phase::Modes, does<&Execution::takeMotion>},
      {Action::Thread, Phase::Modes, does<&Execution::takeMotion>},
      {Action::CurveFeed, Phase::Modes, does<&Execution::takeMotion>},
      {Action::CurveThrough, Phase::Modes, does<&Execution::takeMotion>},
      {Action::CurveTangent, Phase::Modes, does<&Execution::takeMotion>},
      {Action::CurvePoint, Phase::Modes, does<&Execution::takeMotion>},
      {Action::CurveEnd, Phase::None, nullptr, silent, AxisWords::Taken,
       uses<&Execution::endCurve>},
      {Action::Dwell, Phase::None, nullptr, silent, AxisWords::TakenInBlock,
       may<&Execution::dwell>},
      {Action::DataInput, Phase::None, nullptr, silent, AxisWords::Taken,
       uses<&Execution::writeOffsets>},
      {Action::ReferenceReturn, Phase::None, nullptr, silent, AxisWords::TakenInBlock,
       may<&Execution::referenceReturn>},
      {Action::ReferenceCheck, Phase::None, nullptr, silent, AxisWords::TakenInBlock,
       may<&Execution::referenceReturn>},
      {Action::ReferenceFrom, Phase::None, nullptr, silent, AxisWords::TakenInBlock,
       may<&Execution::referenceFrom>},
      {Action::SkipMove, Phase::None, nullptr, silent, AxisWords::TakenInBlock,
       may<&Execution::skipMove>},
      {Action::CompensationOff, Phase::Modes, does<&Execution::compensationOff>},
      {Action::CompensationLeft, Phase::Modes, does<&Execution::compensationOn>},
      {Action::CompensationRight, Phase::Modes, does<&Execution::compensationOn>},
      {Action::LengthPositive, Phase::Modes, does<&Execution::lengthOn>},
      {Action::LengthNegative, Phase::Modes, does<&Execution::lengthOn>},
      {Action::LengthOff, Phase::Modes, does<&Execution::lengthOff>},
      {Action::LengthSet, Phase::Modes, does<&Execution::lengthOn>, silent, AxisWords::Taken},
      {Action::LengthAdd, Phase::Modes, does<&Execution::lengthOn>, silent, AxisWords::Taken},
      {Action::SpeedLimit, Phase::None, nullptr, silent, AxisWords::Taken},
      {Action::LocalShift, Phase::None, nullptr, silent, AxisWords::Taken,
       uses<&Execution::shiftCoordinates>},
      {Action::PresetPosition, Phase::None, nullptr, silent, AxisWords::Taken,
       uses<&Execution::shiftCoordinates>},
      {Action::PresetClear, Phase::None, nullptr, silent, AxisWords::TakenInBlock,
       may<&Execution::switchPreset>},
      {Action::PresetSuspend, Phase::None, nullptr, silent, AxisWords::TakenInBlock,
       may<&Execution::switchPreset>},
      {Action::PresetRestore, Phase::None, nullptr, silent, AxisWords::TakenInBlock,
       may<&Execution::switchPreset>},
      {Action::ZeroSet, Phase::None, nullptr, silent, AxisWords::TakenInBlock,
       uses<&Execution::setSystem>},
      {Action::ZeroHere, Phase::None, nullptr, silent, AxisWords::TakenInBlock,
       uses<&Execution::setSystem>},
      {Action::StorePlace, Phase::None, nullptr, silent, AxisWords::TakenInBlock,
       may<&Execution::storeHere>},
      {Action::MachineMove, Phase::Modes, does<&Execution::countFromMachine>},
      {Action::WorkOffset, Phase::Modes, does<&Execution::workOffset>, EventKind::CoordinateChange},
      {Action::SurfaceSpeed, Phase::Modes, does<&Execution::speedMode>},
      {Action::ConstantSpeed, Phase::Modes, does<&Execution::speedMode>},
      {Action::PolarOn, Phase::Early, does<&Execution::switchPolar>, EventKind::CoordinateChange},
      {Action::PolarOff, Phase::Early, does<&Execution::switchPolar>, EventKind::CoordinateChange},
      {Action::RotationOn, Phase::Early, does<&Execution::transformationOn>,
       EventKind::CoordinateChange, AxisWords::Taken},
      {Action::RotationOff, Phase::Early, does<&Execution::transformationOff>,
       EventKind::CoordinateChange},
      {Action::ScalingOn, Phase::Early, does<&Execution::transformationOn>,
       EventKind::CoordinateChange, AxisWords::Taken},
      {Action::ScalingOff, Phase::Early, does<&Execution::transformationOff>,
       EventKind::CoordinateChange},
      {Action::MirrorOn, Phase::Early, does<&Execution::transformationOn>,
       EventKind::CoordinateChange, AxisWords::Taken},
      {Action::MirrorOff, Phase::Early, does<&Execution::transformationOff>,
       EventKind::CoordinateChange, AxisWords::Taken},
      {Action::FrameSet, Phase::None, nullptr, silent, AxisWords::Taken,
       uses<&Execution::changeFrame>},
      {Action::FrameAdd, Phase::None, nullptr, silent, AxisWords::Taken,
       uses<&Execution::changeFrame>},
      {Action::FrameClear, Phase::None, nullptr, silent, AxisWords::Taken,
       uses<&Execution::changeFrame>},
      {Action::Reset, Phase::Early, does<&Execution::reset>},
      {Action::ProfileBegin, Phase::Early, does<&Execution::beginProfile>},
      {Action::ProfileRun, Phase::Early, does<&Execution::endProfile>, silent,
       AxisWords::TakenInBlock, uses<&Execution::runCompound>},
      {Action::Pole, Phase::None, nullptr, silent, AxisWords::Taken, uses<&Execution::setPole>},
      {Action::PoleFromPlace, Phase::None, nullptr, silent, AxisWords::Taken,
       uses<&Execution::setPole>},
      {Action::PoleFromPole, Phase::None, nullptr, silent, AxisWords::Taken,
       uses<&Execution::setPole>},
      {Action::PolygonOn, Phase::None, nullptr, silent, AxisWords::Taken},
      {Action::ZoneOn, Phase::None, nullptr, silent, AxisWords::Taken},
      {Action::Cycle, Phase::Modes, does<&Execution::takeCycle>, silent, AxisWords::TakenInBlock,
       uses<&Execution::runCompound>},
      {Action::CycleCancel, Phase::Modes, does<&Execution::endCycle>},
      {Action::MacroCall, Phase::Flow, does<&Execution::callMacro>, EventKind::Call,
       AxisWords::TakenInBlock},
      {Action::MacroModal, Phase::Flow, does<&Execution::callModally>, silent, AxisWords::Taken},
      {Action::MacroCancel, Phase::Modes, does<&Execution::cancelModalCall>},
      {Action::ProgramEnd, Phase::Flow, does<&Execution::endProgram>, EventKind::ProgramEnd},
      {Action::ProgramEndRewind, Phase::Flow, does<&Execution::endProgram>, EventKind::ProgramEnd},
      {Action::SpindleCw, Phase::Early, turns<spindleCw>, EventKind::SpindleChange},
      {Action::SpindleCcw, Phase::Early, turns<spindleCcw>, EventKind::SpindleChange},
      {Action::SpindleStop, Phase::Late, turns<spindleOff>, EventKind::SpindleChange},
      {Action::SpindleOrient, Phase::Early, does<&Execution::orientSpindle>,
       EventKind::SpindleChange},
      {Action::LiveToolCw, Phase::Early, turnsLiveTool<spindleCw>},
      {Action::LiveToolCcw, Phase::Early, turnsLiveTool<spindleCcw>},
      {Action::LiveToolStop, Phase::Late, turnsLiveTool<spindleOff>},
      {Action::ToolChange, Phase::Early, does<&Execution::takeTool>},
      {Action::SetTool, Phase::Early, does<&Execution::nameTool>},
      {Action::Clamp, Phase::Early, sets<Fact::SpindleClamped>},
      {Action::Unclamp, Phase::Early, clears<Fact::SpindleClamped>},
      {Action::ChuckClose, Phase::Early, clears<Fact::ChuckOpen>},
      {Action::ChuckOpen, Phase::Early, sets<Fact::ChuckOpen>},
      {Action::AxisEngage, Phase::Early, sets<Fact::AxisEngaged>},
      {Action::AxisRelease, Phase::Early, clears<Fact::AxisEngaged>},
      {Action::CallProgram, Phase::Flow, does<&Execution::callSubprogram>, EventKind::Call},
      {Action::CallLocal, Phase::Flow, does<&Execution::callLocal>, EventKind::Call},
      {Action::Return, Phase::Flow, does<&Execution::returnToCaller>, EventKind::Return},
      {Action::Jump, Phase::Flow, does<&Execution::jumpTo>},
      {Action::ConditionalJump, Phase::Flow, does<&Execution::jumpPerhaps>},
      {Action::ModesKept, Phase::Early, does<&Execution::keepModes>},
      {Action::ModesForgotten, Phase::Early, does<&Execution::forgetModes>},
      {Action::ModesRestored, Phase::Early, does<&Execution::restoreModes>},
      {Action::ModesRestoredAtReturn, Phase::Early, does<&Execution::keepModesOverReturn>},
      {Action::MachineSpecific, Phase::Early, does<&Execution::turnAnything>, silent,
       AxisWords::TakenInBlock, may<&Execution::runUnknown>},
  };

  static constexpr auto byAction() {
    std::array<ActionRow, size_t(Action::MachineSpecific) + 1> rows{};
    for (const ActionRow &row : list)
      rows[size_t(row.action)] = row;
    return rows;
  }
  static const ActionRow &of(Action action);
};

const ActionRow &Execution::Actions::of(Action action) {
  static constexpr auto rows = byAction();
  return rows[size_t(action)];
}

/// Carries out what the code does in this phase.
void Execution::carryOut(Phase phase, const CodeUse &use) {
  const ActionRow &row = Actions::of(info(use).action);
  if (row.phase != phase)
    return;
  if (row.event != Actions::silent) {
    Event &event = outcome_.emit(row.event);
    event.code = use.code;
    event.word = use.word;
  }
  row.effect(*this, use);
}

/// The modes that the code states, and whether it takes the block's axis words.
void Execution::applyModes(const CodeUse &use) {
  const CodeInfo &code = info(use);
  const bool stays = isModal(code);
  if (stays && code.action != Action::Cycle && code.action != Action::CycleCancel)
    activate(code, use.word);
  carryOut(Phase::Modes, use);
  const ActionRow &row = Actions::of(code.action);
  actsLater_ |= row.phase == Phase::Late || row.phase == Phase::Flow;
  const AxisWords words = row.axisWords;
  if (!actionCode_.word &&
      (words == AxisWords::Taken || (words == AxisWords::TakenInBlock && !stays)))
    actionCode_ = use;
}

/// What takes effect before the block's motion.
void Execution::applyEarly(const CodeUse &use) {
  const CodeInfo &code = info(use);
  if (code.effect.index != 0xFF)
    applySwitch(code, use);
  if (!code.stores.empty())
    applyStores(code);
  carryOut(Phase::Early, use);
}

/// What the block's code does with the axis words that it takes; false: the block moves.
bool Execution::axisWordsTaken(uint16_t axes) {
  const ActionRow &row = Actions::of(info(actionCode_).action);
  return !row.axisEffect || row.axisEffect(*this, actionCode_, axes);
}

} // namespace ncvet
