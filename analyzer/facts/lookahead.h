// Looks at blocks round the current one for rules, and at their words.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// Reads the next block in the text after `block` that holds anything to execute, in the same
/// program; `block` is overwritten. False at the program's end. What the control executes next
/// `BlocksAhead` tells.
bool readOn(const FileIndex &index, Block &block);

/// Reads the block with content that is before the current one; false at the program's
/// begin.
bool readPrevious(const RuleContext &ctx, Block &previous);

/// The same, before a block that `readPrevious` returned; `block` is overwritten.
bool readBack(const RuleContext &ctx, Block &block);

/// Whether all axis words of the block are increments of zero: `G18 W0 H0` names axes and moves
/// none.
bool namesAxesAlone(const Dialect &dialect, const Block &block);

/// Where the words of a block of this file are.
SourceRange wordsRange(FileId file, const Block &block);
inline SourceRange wordsRange(const RuleContext &ctx, const Block &block) {
  return wordsRange(ctx.source().id(), block);
}

/// Codes of a block that was read ahead, without their variants.
llvm::SmallVector<CodeIndex, 6> codesOf(const Dialect &dialect, const Block &block);
/// First code of the block with one of the actions, or null.
const CodeInfo *findCode(const Dialect &dialect, const Block &block,
                         std::initializer_list<Action> actions);
/// First code of the block that `holds`, or that does as what it is under one of its conditions
/// (`G70` with P and Q); null: there is none.
const CodeInfo *findReading(const Dialect &dialect, const Block &block,
                            llvm::function_ref<bool(const CodeInfo &)> holds);
/// True when the block holds a motion code (G00 to G03, threads) or a modal cycle.
bool hasMotionCode(const Dialect &dialect, const Block &block);

/// First word of the block that has this role in the code's format, or null.
const Word *wordOf(const Block &block, const CodeInfo &code, Role role);
/// First assignment of the block to a variable that is a word of the code's format, or null.
const Word *assignsWordOf(const Block &block, const CodeInfo &code);
/// All addresses with this role in the code's format.
AddressMask addressesOf(const CodeInfo &code, Role role);
/// Value of a role's word as the active cycle keeps it, or of its variable; none when it is absent
/// or not known.
std::optional<double> kept(const MachineState &state, const CodeInfo &code, Role role);
/// Known value of a role's word in the current block, as written.
std::optional<double> valueOf(const RuleContext &ctx, const CodeInfo &code, Role role);
/// Millimetres per unit of a length in the state; none when the unit is not known.
std::optional<double> millimetresPer(const Dialect &dialect, const MachineState &state);
/// End coordinate of an axis that the block gives: its absolute word, or its increment from
/// `start`.
std::optional<double> endOf(const RuleContext &ctx, Axis axis, const Interval &start);

/// Whether the tool comes from below the work, so that its planes are the other way round: the
/// tables' codes say so in `_BELOW`.
bool comesFromBelow(const MachineState &state);
/// "drills", "taps", "bores", "turns", … for messages.
llvm::StringRef verbOf(CycleKind kind);

/// The block's only word, when it names an element of a contour that this main program does not
/// define: `L100` on a control whose lines are called so; else null.
const Word *undefinedElement(const RuleContext &ctx);

} // namespace ncvet
