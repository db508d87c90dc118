// The order in which the parts of a block take effect.
#include "interp/execute/execution.h"

#include "formats/dialect/control_facts.h"
#include "formats/dialect/measure.h"
#include "interp/execute/switches_of_g.h"
#include "interp/value/units.h"

#include <bit>

namespace ncvet {

namespace {
constexpr uint16_t axisBit(Axis axis) { return uint16_t(1u << unsigned(axis)); }

/// The block is a bracket or a condition of structured flow: nothing of it reaches the axes. A jump
/// alone is a block like others.
bool branchesOnly(const Block &block) {
  const auto branches = [](const Item &item) {
    return item.kind == ItemKind::Structure || item.kind == ItemKind::If;
  };
  return block.words.empty() && llvm::any_of(block.items, branches) &&
         llvm::all_of(block.items, [&](const Item &item) {
           return branches(item) || item.kind == ItemKind::Jump;
         });
}

/// Whether the block holds statements alone: a control that keeps them apart from words works them
/// out beforehand, and they are no block of the path.
bool calculatesOnly(const Block &block) {
  return block.words.empty() && !block.items.empty() &&
         llvm::all_of(block.items, [](const Item &item) {
           switch (item.kind) {
           case ItemKind::Assignment:
           case ItemKind::If:
           case ItemKind::Jump:
           case ItemKind::While:
           case ItemKind::Do:
           case ItemKind::End:
             return true;
           default:
             return false;
           }
         });
}
} // namespace

/// The motion code of a block of axis words and perhaps F under G00 or G01, with no cycle, polar
/// input or modal macro about, and compensation off or built up; `noCode` for other blocks. G codes
/// are for `restatesCodes` to judge.
inline CodeIndex Execution::plainMoveCode() const {
  if ((block_.addresses & ~(dialect_.axisWords | maskOf('F') | maskOf('G'))) ||
      !(block_.addresses & dialect_.axisWords) ||
      (state_.compensation != phaseOff && state_.compensation != phaseOn) || state_.modalCalls ||
      state_.pendingCycle != noCode || masks_.motion == noGroup || polarMayBeOn() ||
      (diameterMayBeOn() && (state_.groups[masks_.diameter] & ~masks_.diameterOn)) ||
      (dialect_.variableRanges.place && !block_.expressions.empty()))
    return noCode;
  if (masks_.cycle != noGroup && (state_.groups[masks_.cycle] & ~(masks_.cancelled | groupUnset)))
    return noCode;
  const uint64_t motionSet = state_.groups[masks_.motion];
  if ((motionSet & (motionSet - 1)) || motionSet == groupUnset)
    return noCode;
  const CodeIndex index =
      dialect_.groups[masks_.motion].members[size_t(std::countr_zero(motionSet))];
  const CodeInfo &code = dialect_.codes[index];
  const bool straight = code.action == Action::Linear || code.action == Action::Rapid;
  return straight && code.places[0].empty() ? index : noCode;
}

namespace {
/// Whether a modal code that is in force already does nothing when it is named again, whatever the
/// numbers of the block.
bool isBare(const Dialect &dialect, const CodeInfo &code) {
  switch (code.action) {
  case Action::Rapid:
  case Action::Linear:
  case Action::PlaneXY:
  case Action::PlaneZX:
  case Action::PlaneYZ:
  case Action::Absolute:
  case Action::Incremental:
  case Action::Inch:
  case Action::Metric:
    break;
  default:
    return false;
  }
  const GroupInfo &group = dialect.groups[code.group];
  return !group.oneShot && !group.forgetsFeed &&
         llvm::none_of(code.variants,
                       [](const Variant &variant) { return asksNumber(variant.when); }) &&
         llvm::none_of(code.notices,
                       [](const Notice &notice) { return asksNumber(notice.when); }) &&
         code.stores.empty() && code.effect.index == 0xFF && code.places[0].empty() &&
         !code.ownMove && !code.returns && !code.leavesNoSpeed && !code.traits;
}
} // namespace

/// Whether all codes of the block are in force already and do nothing more: then they are told, and
/// noted as set here.
bool Execution::restatesCodes() {
  if (!block_.expressions.empty() || !block_.issues.empty())
    return false;
  for (const Word &word : block_.words) {
    if (word.address != letterAddress('G'))
      continue;
    const CodeIndex index = word.isNumber() ? dialect_.find('G', word.codeNumber()) : noCode;
    const CodeInfo *code = index == noCode ? nullptr : &dialect_.codes[index];
    if (!code || code->group == noGroup || !isBare(dialect_, *code) ||
        state_.groups[code->group] != uint64_t(1) << code->bit || !state_.isStated(code->group)) {
      outcome_.codes.clear();
      return false;
    }
    outcome_.codes.push_back({index, &word});
  }
  context_.codes = outcome_.codes;
  for (const CodeUse &use : outcome_.codes)
    if (llvm::any_of(info(use).variants, [&](const Variant &variant) {
          return holds(variant.when, &info(use), context_);
        })) {
      outcome_.codes.clear();
      return false;
    }
  emitCodes();
  for (const CodeUse &use : outcome_.codes)
    state_.origin.setGroup(info(use).group, originOf(*use.word));
  return true;
}

PlainTarget Execution::plainTarget(const AddressInfo &address, Truth relative) const {
  PlainTarget target;
  target.axis = address.axis;
  target.isLength = address.unit == AddressUnit::Length;
  target.isHalved = target.isLength && address.axis == Axis::X && diameterMayBeOn();
  target.isIncrement = relative == Truth::Yes || address.kind == AddressKind::Increment;
  target.inIncrements = masks_.pointlessIsIncrement;
  return target;
}

/// By far the most blocks of a long program, see `plainMoveCode`. Does what `moveAxes` would do,
/// with everything that such a block cannot do left out.
bool Execution::runPlainMove() {
  const CodeIndex index = plainMoveCode();
  if (index == noCode)
    return false;
  const Interval factor = lengthFactor();
  const Truth relative = incremental();
  if (!factor.isConstant() || relative == Truth::Unknown)
    return false;
  bool plain = outcome_.kinds == bitOf(EventKind::Block) &&
               !(masks_.timeOfBlock && !(state_.group(masks_.feedMode) & ~masks_.timeOfBlock));
  if ((block_.addresses & maskOf('G')) && !restatesCodes())
    return false;
  if (block_.addresses & maskOf('F')) {
    technologyWords();
    plain = false;
  }
  uint16_t axes = 0;
  for (const Word &word : block_.words) {
    const AddressInfo &address = dialect_.addresses[word.address];
    if (address.kind != AddressKind::Axis && address.kind != AddressKind::Increment)
      continue;
    axes |= axisBit(address.axis);
    if (word.flags & (wordExpression | wordNoValue | wordIncremental)) {
      storeTarget(word, false);
      plain = false;
    } else {
      plainTarget(address, relative).move(word, factor.lo, state_);
    }
  }
  const bool idles = state_.compensation == phaseOn && countIdle(axes);
  outcome_.plainMove = plain && !idles && block_.skip < 0 && !block_.lowerCase;
  const bool rapid = dialect_.codes[index].action == Action::Rapid;
  Event &event = outcome_.emit(EventKind::Motion);
  event.code = index;
  event.motion = rapid ? MotionKind::Rapid : MotionKind::Feed;
  event.axes = axes;
  if (state_.compensation == phaseOn &&
      !(state_.must(Fact::CompensatedCut) && state_.must(Fact::ContourCompensated)))
    contourFacts(event.motion, axes);
  afterMove(rapid, axes);
  return true;
}

std::optional<PlainMove> Execution::asPlainMove() const {
  constexpr size_t most = 200; // words: the index of one is a byte
  if (!outcome_.plainMove || outcome_.events.empty() || block_.words.size() > most)
    return std::nullopt;
  const Event &motion = outcome_.events.back();
  constexpr uint64_t contour = bitOf(Fact::CompensatedCut) | bitOf(Fact::ContourCompensated);
  if (motion.kind != EventKind::Motion ||
      (state_.compensation == phaseOn &&
       ((state_.factsMust & contour) != contour || state_.idleBlocks ||
        !(motion.axes & planeAxes(dialect_, state_)))))
    return std::nullopt;
  PlainMove move;
  const Truth relative = incremental();
  move.unit = lengthFactor().lo;
  move.isRapid = motion.motion == MotionKind::Rapid;
  move.tracksDepth = !dialect_.isLathe();
  for (uint8_t i = 0; i < block_.words.size(); ++i)
    if (const AddressInfo &address = dialect_.addresses[block_.words[i].address];
        address.kind == AddressKind::Axis || address.kind == AddressKind::Increment)
      move.steps.push_back({i, plainTarget(address, relative)});
  for (const CodeUse &use : outcome_.codes)
    move.restated.push_back({uint8_t(use.word - block_.words.begin()), info(use).group});
  move.simple = simpleAxes(move.steps, block_, move.unit);
  return move;
}

/// Under compensation: counts the blocks without a move in the plane; false when there is nothing
/// to count. Where compensation is only perhaps in force it is enough that there was one: else a
/// program would be another for each number of calls that lead to it.
bool Execution::countIdle(uint16_t axes) {
  const bool moved = axes & planeAxes(dialect_, state_);
  const int most = state_.compensation == phaseOn ? 255 : 1;
  if (state_.idleBlocks == (moved ? 0 : most))
    return false;
  state_.idleBlocks = moved ? 0 : uint8_t(std::min(most, state_.idleBlocks + 1));
  outcome_.setupChanged = true;
  return true;
}

/// Whether reading was lost at such an issue: what comes next to it may be read as what it is not.
static bool isLost(SyntaxIssueKind kind) {
  switch (kind) {
  case SyntaxIssueKind::InvalidCharacter:
  case SyntaxIssueKind::UnbalancedBracket:
  case SyntaxIssueKind::BadExpression:
  case SyntaxIssueKind::BadStatement:
  case SyntaxIssueKind::UnknownAttribute:
    return true;
  default:
    return false;
  }
}

/// Those that only follow from the one before them are not told.
void Execution::syntaxIssues() {
  constexpr uint32_t blank = 1; // between two that are next to each other
  bool lost = false;
  uint32_t end = 0;
  for (size_t i = 0; i < block_.issues.size(); ++i) {
    const SyntaxIssue &issue = block_.issues[i];
    const bool unread = isLost(issue.kind) || issue.kind == SyntaxIssueKind::MissingAddress;
    const bool follows = lost && unread && issue.begin >= end && issue.begin - end <= blank;
    if (!follows)
      outcome_.emit(EventKind::Syntax).setIssue(i);
    lost = follows || isLost(issue.kind);
    end = issue.end;
  }
}

void Execution::run(bool guardHolds) {
  stateUse.groups |= masks_.everyBlock;
  if (inForeignLanguage())
    return foreignBlock();
  outcome_.emit(EventKind::Block);
  if (!block_.issues.empty())
    syntaxIssues();
  if ((block_.addresses & ~dialect_.plain) | (block_.repeated & ~dialect_.repeatable) |
          (block_.pointless & dialect_.pointAdvised) | (block_.pointed & dialect_.whole) ||
      block_.skip > int8_t(dialect_.lexical.skipLevels))
    wordIssues();
  if (!block_.operations.empty() && !block_.words.empty())
    wordDomains();
  if (block_.items.empty()) {
    if (runPlainMove())
      return;
    if (block_.words.empty() && !runsEmpty())
      return;
  }
  outcome_.setupChanged = true;
  if (!block_.items.empty() && !runItems(guardHolds))
    return;
  if (block_.words.empty() && !runsEmpty()) {
    otherSpindles();
    return finish();
  }
  if (!block_.expressions.empty())
    unsetReads();
  resolveCodes();
  // Modes first, then what they give a meaning to: an F after G98 is a feed per minute.
  for (const CodeUse &use : outcome_.codes)
    applyModes(use);
  technologyWords();
  if (block_.hasAny(dialect_.speedLimitWords | dialect_.orientWords | dialect_.switchWords |
                    dialect_.feedWords))
    settingWords();
  otherSpindles();
  for (const CodeUse &use : outcome_.codes)
    applyEarly(use);
  applyZeros();
  if (isRefused())
    forgetTargets();
  else
    moveAxes();
  if (actsLater_)
    for (const Phase phase : {Phase::Late, Phase::Flow})
      for (const CodeUse &use : outcome_.codes)
        carryOut(phase, use);
  finish();
}

/// A G code that is in no table has the axis words, unless the block moves by a code of its own.
bool Execution::isRefused() const {
  return (outcome_.kinds & bitOf(EventKind::UnknownCode)) &&
         llvm::any_of(outcome_.events,
                      [](const Event &event) {
                        return event.kind == EventKind::UnknownCode &&
                               event.word->address == letterAddress('G');
                      }) &&
         llvm::none_of(outcome_.codes,
                       [&](const CodeUse &use) { return isMotion(info(use).action); });
}

/// Where its axes go is not known.
void Execution::forgetTargets() {
  for (const Word &word : block_.words)
    if (dialect_.axisWords & maskOf(word.address))
      state_.position[size_t(dialect_.addresses[word.address].axis)] = Interval::unknown();
}

/// Variables without a value in the words of the block.
void Execution::unsetReads() {
  for (const Word &word : block_.words) {
    if (!word.has(wordExpression))
      continue;
    const Expression &expression = block_.expressions[size_t(word.mantissa)];
    for (uint32_t i = 0; i < expression.count; ++i) {
      const ExpressionOp &op = block_.operations[expression.first + i];
      if (op.op == Op::Variable)
        emitUnsetRead(state_, op, outcome_);
    }
  }
}

/// A block without words in which an active cycle runs all the same.
bool Execution::runsEmpty() const {
  return dialect_.emptyBlocksRun && state_.cycleActive(dialect_) != Truth::No;
}

/// Tells what is odd about the words, so that rules need not look at every block.
void Execution::wordIssues() {
  const auto emit = [&](WordIssue issue, AddressMask which) {
    const Word *word = block_.findAny(which);
    if (!word)
      return;
    Event &event = outcome_.emit(EventKind::WordIssue);
    event.setWordIssue(issue);
    event.word = word;
  };
  emit(WordIssue::Unknown, block_.addresses & ~dialect_.known);
  emit(WordIssue::Repeated, block_.repeated & ~dialect_.repeatable);
  emit(WordIssue::NoPoint, block_.pointless & dialect_.pointAdvised);
  emit(WordIssue::PointInWhole, block_.pointed & dialect_.whole);
  if (block_.skip > int8_t(dialect_.lexical.skipLevels))
    outcome_.emit(EventKind::WordIssue).setWordIssue(WordIssue::SkipLevel);
  emit(WordIssue::NumberInside, block_.addresses & maskOf('N'));
  emit(WordIssue::Special, block_.addresses & dialect_.known & ~dialect_.plain);
}

void Execution::resolveCodes() {
  constexpr AddressMask codeLetters = maskOf('G') | maskOf('M') | maskOf(keywordAddress);
  if (!(block_.addresses & codeLetters))
    return;
  for (const Word &word : block_.words) {
    if (!(codeLetters & maskOf(word.address)))
      continue;
    if (word.address == keywordAddress) {
      outcome_.codes.push_back({CodeIndex(word.mantissa), &word});
      continue;
    }
    if (word.has(wordExpression)) {
      computedCode(word);
      continue;
    }
    if (word.has(wordNoValue))
      continue;
    CodeIndex code = dialect_.find(char('A' + word.address), word.codeNumber());
    if (code == noCode)
      code = macroOfBuilder(word);
    if (code == noCode)
      unknownCode(word);
    else
      outcome_.codes.push_back({code, &word});
  }
  resolveVariants();
  emitCodes();
}

void Execution::emitCodes() {
  for (const CodeUse &use : outcome_.codes) {
    Event &event = outcome_.emit(EventKind::Code);
    event.code = use.code;
    event.word = use.word;
  }
}

/// `G#1`: which code it is decides itself at run time.
void Execution::computedCode(const Word &word) {
  const Interval number = value(word);
  if (number.isConstant() && number.value() >= 0 && number.value() < 10000) {
    const CodeIndex code =
        dialect_.find(char('A' + word.address), uint32_t(std::lround(number.value() * 10)));
    if (code != noCode) {
      outcome_.codes.push_back({code, &word});
      return;
    }
    outcome_.emit(EventKind::UnknownCode).word = &word; // it is known, and it is none
  }
  state_.set(Fact::UnknownCode);
}

/// The entry that counts for codes with which the machine's builder calls macros: G codes from a
/// number on, and M codes that name a program.
CodeIndex Execution::macroOfBuilder(const Word &word) const {
  const CodeIndex macro = dialect_.builderMacro;
  if (macro == noCode ||
      (word.address == letterAddress('G') ? word.codeNumber() < dialect_.codes[macro].number
                                          : !block_.has(letterAddress('P'))))
    return noCode;
  return macro;
}

void Execution::unknownCode(const Word &word) {
  Event &event = outcome_.emit(EventKind::UnknownCode);
  event.word = &word;
  // What the machine's builder does on a mill with an M code leaves the modes of G codes alone.
  if (word.address != letterAddress('M') || dialect_.isLathe())
    state_.set(Fact::UnknownCode);
  if (word.address == letterAddress('M')) {
    // The machine's builder knows what it does: it may start or stop anything.
    turnAnySpindle();
    stateUse.everything();
    const uint32_t modes = switchesOfG(dialect_);
    state_.switches.may |= ~modes;
    state_.switches.must &= modes;
  }
}

/// Puts variants in place of the codes whose meaning the block's other words decide.
void Execution::resolveVariants() {
  context_.codes = outcome_.codes;
  for (CodeUse &use : outcome_.codes) {
    const CodeInfo &base = dialect_.codes[use.code];
    const auto variant = llvm::find_if(base.variants, [&](const Variant &candidate) {
      return holds(candidate.when, &base, context_);
    });
    if (variant != base.variants.end()) {
      use.code = variant->code;
    } else if (has(base, CycleTrait::KeepsWords)) {
      // Restated without the words that make it a variant: the cycle in force has kept them.
      const CodeInfo *running = before_.activeCode(dialect_, StandardGroup::Cycle);
      if (running && running->base == use.code)
        use.code = CodeIndex(running - dialect_.codes.data());
    }
  }
}

void Execution::finish() {
  for (const auto &[variable, value] : pending_)
    writeVariable(state_, variable, value);
  // A parameter block waits for the very next block only.
  if (before_.pendingCycle != noCode && state_.pendingCycle == before_.pendingCycle &&
      state_.origin.of(StatePart::PendingCycle).begin ==
          before_.origin.of(StatePart::PendingCycle).begin)
    state_.pendingCycle = noCode;
  // Where a word has lost its address or its value, nobody knows where the tool was to go.
  if (llvm::any_of(block_.issues, [](const SyntaxIssue &issue) {
        return issue.kind == SyntaxIssueKind::MissingAddress;
      }))
    for (Interval &place : state_.position)
      place = Interval::unknown();
  if (!(state_.compensation & phaseOn)) {
    state_.idleBlocks = 0;
  } else if (!branchesOnly(block_) &&
             (!dialect_.facts->text.statementsAlone || !calculatesOnly(block_))) {
    countIdle(outcome_.kinds & bitOf(EventKind::CycleRun) ? planeAxes(dialect_, state_)
                                                          : axesMoved());
  }
  if (state_.modalCalls)
    outcome_.callsModally = firesModalCall();
}

} // namespace ncvet
