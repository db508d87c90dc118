// The work of executing one block, shared by the files that each do a part of it.
#pragma once

#include "interp/evaluate/condition.h"
#include "interp/evaluate/expression.h"
#include "interp/execute/known_move.h"
#include "interp/execute/mode_masks.h"
#include "interp/geometry/plane_place.h"
#include "interp/state/event.h"
#include "interp/state/modes.h"

namespace ncvet {

struct Zero;

/// When in its block an action takes effect.
enum class Phase : uint8_t {
  None,
  Modes, ///< before the block's F and S: modes give them their meaning
  Early, ///< before the block's motion
  Late,  ///< after it
  Flow   ///< last: where control goes
};

/// One block on its way through the interpreter. Private to interp/.
class Execution {
public:
  Execution(const Dialect &dialect, const MachineProfile &machine, const ModeMasks &masks,
            FileId file, const Block &block, const MachineState &before, MachineState &state,
            Outcome &outcome)
      : dialect_(dialect), machine_(machine), masks_(masks), file_(file), block_(block),
        before_(before), state_(state),
        outcome_(outcome), context_{dialect, machine, block, {}, before} {}

  void run(bool guardHolds);
  /// The block, which has just been executed, as a plain move that may follow itself; nothing when
  /// its numbers decide more than where it leads.
  std::optional<PlainMove> asPlainMove() const;
  /// The same of a block that is spelled as this one, in the same modes. `use`: what executing it
  /// has looked at.
  std::optional<KnownMove> asKnownMove(const StateUse &use) const;

private:
  // execution.cpp: the order of things
  bool inForeignLanguage() const;
  bool choosesLanguageOnly() const;
  void forgetForeign();
  CodeIndex plainMoveCode() const;
  bool restatesCodes();
  void emitCodes();
  PlainTarget plainTarget(const AddressInfo &address, Truth relative) const;
  bool runPlainMove();
  bool countIdle(uint16_t axes);
  uint16_t axesMoved() const;
  void wordIssues();
  void syntaxIssues();
  bool runsEmpty() const;
  void resolveCodes();
  void computedCode(const Word &word);
  CodeIndex macroOfBuilder(const Word &word) const;
  void unknownCode(const Word &word);
  void resolveVariants();
  bool isRefused() const;
  void forgetTargets();
  void unsetReads();
  void finish();

  // make_known_move.cpp
  bool isKnownCode(const CodeUse &use) const;
  bool isKnownCompensation() const;
  bool isKnownExpression(const Word &word) const;
  bool isKnownKind() const;
  bool isKnownMotion(KnownMove &move) const;
  bool isKnownHole(KnownMove &move) const;
  bool knownPlaces(KnownMove &move, const StateUse &use) const;

  // statements.cpp: Macro B
  void wordDomains();
  /// The IF of the block, as far as its items have been run.
  struct Guard {
    bool holds = true;        ///< what a statement after the IF asks
    bool conditional = false; ///< a condition waits for its jump
    Truth condition = Truth::Yes;
  };
  enum class Items : uint8_t { GoOn, Done, Stop };
  bool runItems(bool guardHolds);
  Items runItem(size_t index, Guard &guard);
  Items jump(size_t index, Guard &guard);
  Items loop(FlowKind kind, const Item &item);
  void callOrRepeat(size_t index);
  void go(FlowKind kind, size_t index);
  void structure(size_t index);
  void assign(const Item &item);
  void giveBack(const Item &item);
  void define(const Item &item);

  // action_table.cpp: which action does what, and when
  struct Actions;
  void carryOut(Phase phase, const CodeUse &use);
  void applyModes(const CodeUse &use);
  void applyEarly(const CodeUse &use);
  bool axisWordsTaken(uint16_t axes);

  // codes.cpp: the effect of single codes
  void applySwitch(const CodeInfo &info, const CodeUse &use);
  void applyStores(const CodeInfo &info);
  void activate(const CodeInfo &info, const Word *word);
  void speedMode(const CodeUse &use);
  void compensationOn(const CodeUse &use);
  void compensationOff(const CodeUse &use);
  void lengthOn(const CodeUse &use);
  void lengthOff(const CodeUse &use);
  void cancelModalCall(const CodeUse &use);
  void countFromMachine(const CodeUse &use);
  void takeMotion(const CodeUse &use);
  void takeCycle(const CodeUse &use);
  void endCycle(const CodeUse &use);
  void keepModes(const CodeUse &use);
  void keepModesOverReturn(const CodeUse &use);
  void forgetModes(const CodeUse &use);
  void restoreModes(const CodeUse &use);
  void beginProfile(const CodeUse &use);
  void endProfile(const CodeUse &use);
  void reset(const CodeUse &use);

  // technology.cpp: feed, speed, spindle and tool
  /// What the block's codes make of its technology words.
  struct TechnologyUse {
    bool lead = false;       ///< F and E are leads of a thread
    bool limit = false;      ///< S is a limit
    bool arguments = false;  ///< all of them are arguments of a macro
    AddressMask ofCycle = 0; ///< H and D that are words of a cycle
    AddressMask dwell = 0;   ///< times, or revolutions
  };
  TechnologyUse technologyUse() const;
  void technologyWords();
  void feedWord(const Word &word, bool lead);
  void speedWord(const Word &word, bool limit);
  void offsetWord(const Word &word, AddressMask ofCycle);
  void otherSpindles();
  void otherSpindle(const Item &item);
  void settingWords();
  bool startsSpindle() const;
  void setSpindle(uint8_t direction, const CodeUse &use);
  void orientSpindle(const CodeUse &use);
  void turnAnything(const CodeUse &use);
  void turnAnySpindle();
  void takeTool(const CodeUse &use);
  void nameTool(const CodeUse &use);
  void changeTool(int32_t tool, int32_t offset, const Word &word, CodeIndex by);
  void toolWord(const Word &word);

  // flow.cpp: calls, returns, ends
  void go(FlowKind kind, const CodeUse &use);
  void callMacro(const CodeUse &use);
  void callSubprogram(const CodeUse &use);
  void callLocal(const CodeUse &use);
  void returnToCaller(const CodeUse &use);
  void jumpPerhaps(const CodeUse &use);
  void jumpTo(const CodeUse &use);
  void endProgram(const CodeUse &use);
  void callProgram(const CodeUse &use, bool macro);
  void callModally(const CodeUse &use);
  void mistakenArguments(const CodeUse &use);
  void callModally(const Item &item);
  Truth firesModalCall() const;
  bool motionCodeAlone() const;

  // foreign.cpp: text in the language of another control
  void foreignBlock();

  // motion.cpp: axis words
  void moveAxes();
  bool cycleGoesOn(uint16_t axes);
  uint16_t axesMovedBy(const CodeInfo &motion, uint16_t axes) const;
  void moveByModes(uint16_t axes);
  void moveBy(const CodeInfo *code, CodeIndex index, MotionKind kind, uint16_t axes);
  void afterMove(bool rapid, uint16_t axes);
  void angleWords();
  bool hasAngleWord() const;
  void alongAngle(uint16_t written);
  void contourFacts(MotionKind kind, uint16_t axes);
  Interval coordinate(const Word &word) const;
  /// The same of a word that is never a diameter.
  Interval lengthOfWord(const Word &word) const;
  void storeTarget(const Word &word, bool machineCoordinates);
  void storeTargets();
  void storeGivenTargets();
  void arriveOnMachine();
  Event &emitMotion(MotionKind kind, uint16_t axes, CodeIndex code);
  void storePolarEnd(const CodeInfo &code);
  void compensationStep(MotionKind kind, uint16_t axes);

  // coordinate_codes.cpp: axis words that are no plain move
  /// Under which the last point of a curve waits for its end: no program's key.
  static constexpr int32_t curvePoint = 0x7FFFFF00;
  void machineMove(uint16_t axes);
  bool referenceReturn(const CodeUse &use, uint16_t axes);
  bool runUnknown(const CodeUse &use, uint16_t axes);
  bool referenceFrom(const CodeUse &use, uint16_t axes);
  bool skipMove(const CodeUse &use, uint16_t axes);
  void endCurve(const CodeUse &use);
  bool dwell(const CodeUse &use, uint16_t axes);
  void writeOffsets(const CodeUse &use);
  bool switchPreset(const CodeUse &use, uint16_t axes);
  bool storeHere(const CodeUse &use, uint16_t axes);
  void setPole(const CodeUse &use);
  void shiftCoordinates(const CodeUse &use);
  void changeFrame(const CodeUse &use);
  void workOffset(const CodeUse &use);
  void transformationOn(const CodeUse &use);
  void transformationOff(const CodeUse &use);
  void switchPolar(const CodeUse &use);

  // zero_point_codes.cpp: the zero point, where variables hold it
  void applyZeros();
  void applyLength(const CodeUse &use);
  std::array<Interval, axisCount> lengthOfTool() const;
  void setToolLength();
  void setSystem(const CodeUse &use);
  void setPreset(bool local);
  void switchPreset(Action action);
  void systemMoved(const Zero &before);
  void fromMachine();
  std::array<Interval, axisCount> known() const;
  void moveTo(const std::array<Interval, axisCount> &place);

  // polar.cpp: end points by angle and radius
  PlanePlace inPlane() const;
  void setInPlane(const PlanePlace &place);
  Truth countsFromBefore(const Word &word) const;
  void polarInput(const PlanePlace &from);
  void polarTarget();
  void setPole(Action reference);

  // frame_codes.cpp: shift, rotation, scale, mirror
  /// What the axis words of a block give for X, Y and Z.
  struct FrameWords {
    std::array<bool, 3> given{};
    std::array<bool, 3> adds{}; ///< the value counts from what the axis had
    std::array<double, 3> value{};
  };
  void applyFrame(const CodeUse &use);
  void rebase(const FrameStack &frames);
  std::optional<FrameWords> frameWords(FrameKind kind, bool lengths) const;
  std::optional<Frame> frameOf(const CodeInfo &code) const;
  std::optional<double> frameNumber(const CodeInfo &code, Role role) const;
  std::optional<Frame> frameOfSteps(const CodeInfo &code) const;
  Frame frameOfStep(const FrameStep &step, std::array<double, 12> numbers, double unit) const;
  std::optional<Frame> frameByAxis(const CodeInfo &code, const std::optional<Frame> &old) const;
  void endMirror(const CodeInfo &code, FrameStack &frames) const;
  std::array<double, 3> centreOf(const FrameWords &words, unsigned axes) const;
  std::optional<Frame> rotationAbout(const FrameWords &words, std::optional<double> degrees) const;
  Frame rotationOf(const FrameWords &words, std::optional<double> degrees) const;
  static bool isTransformation(const CodeInfo &code);

  // cycles.cpp
  void beginCycle(const CodeUse &use);
  void startCycle(const CodeUse &use);
  void runCycle(CodeIndex code, uint16_t axes);
  void drillHoles(const CodeInfo &code, uint16_t axes);
  Interval levelAfterCycle(const CodeInfo &code, const WordSpec *height) const;
  void cancelCycle(CodeIndex by, const Word *word);
  void storeCycleWords(bool fresh);
  void runCompound(const CodeUse &use);
  void readProfile(const CodeUse &use, AddressMask first, AddressMask last);
  void endOfCall(const CodeInfo &code);
  void endDownHere(const CodeInfo &code);
  bool patternPlaces(const CodeInfo &code);
  void contourProgram(const CodeUse &use, const WordSpec &spec);
  Interval noLowerThanApproach(const Interval &level) const;
  std::optional<Interval> heightOfVariable(const CodeInfo &code) const;
  CodeIndex activeCycle() const;

  Origin originOf(const Word &word) const { return {file_, word.offset, block_.endOf(word)}; }
  // The groups of these are noted once a block, see `run`.

  /// Millimetres per unit of a programmed length; none when it is not known which unit is in force.
  Interval lengthFactor() const;
  Truth incremental() const; ///< distance mode
  bool polarMayBeOn() const {
    return masks_.polar != noGroup && (state_.groups[masks_.polar] & masks_.polarOn);
  }
  bool diameterMayBeOn() const {
    const uint64_t on = masks_.diameterOn | masks_.diameterAbsolute;
    return on && (state_.groups[masks_.diameter] & on);
  }
  Truth polarOn() const {
    return state_.groups[masks_.polar] & ~masks_.polarOn & ~groupUnset ? Truth::Unknown
                                                                       : Truth::Yes;
  }
  Interval value(const Word &word) const { return assignedWordValue(word, block_, state_); }
  const CodeInfo &info(const CodeUse &use) const { return dialect_.codes[use.code]; }
  /// Whether a code stays in force after its block.
  bool isModal(const CodeInfo &code) const {
    return code.group != noGroup && !dialect_.groups[code.group].oneShot;
  }

  const Dialect &dialect_;
  const MachineProfile &machine_;
  const ModeMasks &masks_;
  const FileId file_;
  const Block &block_;
  const MachineState &before_;
  MachineState &state_;
  Outcome &outcome_;
  ConditionContext context_;

  /// Assignments that take effect after the block's words: the variable and its value.
  llvm::SmallVector<std::pair<int64_t, Value>, 2> pending_;

  CodeUse motionCode_;     ///< motion or modal cycle code of the block
  CodeUse actionCode_;     ///< one-shot code that takes the block's axis words
  bool actsLater_ = false; ///< a code takes effect after the block's motion
  bool machineMove_ = false;
  bool cancelled_ = false;    ///< the block ends the active cycle
  bool callsModally_ = false; ///< the block makes a program run after every later move
};

} // namespace ncvet
