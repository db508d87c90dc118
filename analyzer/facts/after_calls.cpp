// What the callers of a program do after their calls, for rules on what a return leaves in force.
#include "analyzer/facts/after_calls.h"

#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/callers.h"

namespace ncvet {

namespace {

/// Blocks after a call: modes are ended long before that.
constexpr unsigned mostBlocksAfter = 60;

/// Whether the blocks that come end the mode before one relies on it.
bool endsAfter(BlocksAhead ahead, llvm::function_ref<AfterCall(const Block &)> judge) {
  Block block;
  for (unsigned i = 0; i < mostBlocksAfter; ++i) {
    if (!ahead.next(block) || !block.items.empty())
      return false;
    const AfterCall after = judge(block);
    if (after == AfterCall::Relies)
      return false;
    if (after == AfterCall::Ends && block.skip < 0)
      return true;
  }
  return false;
}

/// Whether the program itself ends the mode before it relies on it: a call that repeats it comes
/// back to its first block.
bool beginsWithEnd(const FileIndex &index, const ProgramInfo &program,
                   llvm::function_ref<void()> begin,
                   llvm::function_ref<AfterCall(const Block &)> judge) {
  begin();
  Block block;
  index.read(program.body, block);
  for (unsigned i = 0; i < mostBlocksAfter && block.items.empty(); ++i) {
    const AfterCall after = block.isEmpty() ? AfterCall::GoesOn : judge(block);
    if (after != AfterCall::GoesOn || !readOn(index, block))
      return after == AfterCall::Ends && block.skip < 0;
  }
  return false;
}

bool endsAfterEveryCall(const RuleContext &ctx, llvm::function_ref<void()> begin,
                        llvm::function_ref<AfterCall(const Block &)> judge) {
  const ProgramInfo &own = ctx.index().programAt(ctx.block().begin);
  // Blocks of the caller's own program: no other program calls them.
  if (ctx.caller() && ctx.caller()->program == &own) {
    begin();
    return ctx.caller()->once && endsAfter(BlocksAhead(ctx), judge);
  }
  const Callers callers = callersOf(ctx.unit(), own);
  if (!callers.all || callers.places.empty())
    return false;
  return llvm::all_of(callers.places, [&](const CallPlace &call) {
    Block block;
    call.unit->index.read(call.block, block);
    begin();
    return endsAfter({*call.unit, block}, judge) &&
           (call.once || beginsWithEnd(ctx.index(), own, begin, judge));
  });
}

} // namespace

bool AfterCalls::allEnd(uint64_t mode, const RuleContext &ctx, llvm::function_ref<void()> begin,
                        llvm::function_ref<AfterCall(const Block &)> judge) const {
  const uint32_t program = ctx.index().programAt(ctx.block().begin).begin;
  return answers_.of({ctx.source().id(), program, mode},
                     [&] { return endsAfterEveryCall(ctx, begin, judge); });
}

} // namespace ncvet
