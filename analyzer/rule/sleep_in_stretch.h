// How a rule that is told of every move says that the next ones do not interest it.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// How long the rule that is being told will have nothing to say of that event.
enum class RuleSleep : uint8_t {
  No,
  InStretch,   ///< until the stretch of blocks ends
  WhileMoving, ///< the same, but for moves that lead to where the tool is
  InShape,     ///< of any block of this shape in these modes
  InRow,       ///< the same, of blocks without a comment that a place follows
  AtBlock      ///< of this block of the text in these modes
};

/// Of the rule that is being told, on this thread; the dispatcher looks at it after each call.
inline constinit thread_local RuleSleep ruleSleep = RuleSleep::No;

/// The rule has nothing to say of the following moves either, as long as each only goes on as the
/// one before: in the same modes, with the same facts known, with the same words. Only such things
/// may decide it, no number of the block.
inline void sleepInStretch() { ruleSleep = RuleSleep::InStretch; }

/// The same of following moves that lead somewhere: of one that leaves every axis where it was the
/// rule is told.
inline void sleepWhileMoving() { ruleSleep = RuleSleep::WhileMoving; }

/// The rule has nothing to say of this event in any block of this shape (see `shapeOf`) in these
/// modes, wherever it comes, and remembers nothing of it. What decides that is the shape, the parts
/// of the state that note when they are looked at, and the modes that `modesOf` names: no
/// coordinate, no other number of the cycle in force, nothing that the rule remembers, no text and
/// no other block.
inline void sleepInShape() { ruleSleep = RuleSleep::InShape; }

/// Whether the next block of the text is known to be nothing but words of axes: it goes on with
/// what is in force. False: it is another, or that is not known without reading it.
bool isFollowedByPlace(const RuleContext &ctx);

/// The same of such blocks in a row: they have no comment, and `isFollowedByPlace` is true.
inline void sleepInRow() { ruleSleep = RuleSleep::InRow; }

/// As `sleepInShape`, of this block of the text alone, where texts decide too: that of the block,
/// of others and of callers. It counts when the block is executed again.
inline void sleepAtBlock() { ruleSleep = RuleSleep::AtBlock; }

/// Whether a number of the block decides what the table has to say of a code for rule `id`.
bool asksNumbers(const CodeInfo &code, llvm::StringRef id);

} // namespace ncvet
