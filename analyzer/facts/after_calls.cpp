// What the callers of a program do after their calls, for rules on what a return leaves in force.
#include "analyzer/facts/after_calls.h"

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"

namespace ncvet {

namespace {

/// No longer file is looked through for calls, in bytes.
constexpr uint32_t longest = 200000;
/// Blocks after a call: modes are ended long before that.
constexpr unsigned lookAhead = 60;

/// Whether the block calls the program with this number; `once` tells that it does so one time.
bool calls(const ReferenceReader &references, const RuleContext &ctx, const Block &block,
           int64_t number, bool &once) {
  if (!findCode(ctx.dialect(), block, {Action::CallProgram}))
    return false;
  bool found = false;
  references.words(block, ctx.source().text(), [&](const Reference &call) {
    if (call.kind != ReferenceKind::Call)
      return;
    const bool untold = call.to == ReferredKind::UntoldProgram; // it may be this one
    if (!untold && (call.to != ReferredKind::Program || call.number != number))
      return;
    found = true;
    once = !untold && call.runs == 1;
  });
  return found;
}

/// Whether the blocks after `block` end the mode before one relies on it.
bool endsAfter(const FileIndex &index, Block block,
               llvm::function_ref<AfterCall(const Block &)> judge) {
  for (unsigned i = 0; i < lookAhead; ++i) {
    if (!readOn(index, block) || !block.items.empty())
      return false;
    const AfterCall after = judge(block);
    if (after == AfterCall::Relies)
      return false;
    if (after == AfterCall::Ends && block.skip < 0)
      return true;
  }
  return false;
}

bool endsAfterEveryCall(const RuleContext &ctx, llvm::function_ref<void()> begin,
                        llvm::function_ref<AfterCall(const Block &)> judge) {
  const FileIndex &index = ctx.index();
  const ProgramInfo &own = index.programAt(ctx.block().begin);
  if (own.number < 0 || ctx.source().text().size() > longest)
    return false;
  bool called = false;
  const ReferenceReader references(ctx.dialect());
  for (const ProgramInfo &program : index.programs())
    for (const Block &block : blocks(index, program.body, program.end)) {
      bool once = true;
      if (!calls(references, ctx, block, own.number, once))
        continue;
      begin();
      if (!once || !endsAfter(index, block, judge))
        return false;
      called = true;
    }
  return called;
}

} // namespace

bool AfterCalls::allEnd(uint64_t mode, const RuleContext &ctx, llvm::function_ref<void()> begin,
                        llvm::function_ref<AfterCall(const Block &)> judge) const {
  const uint32_t program = ctx.index().programAt(ctx.block().begin).begin;
  return answers_.of({ctx.source().id(), program, mode},
                     [&] { return endsAfterEveryCall(ctx, begin, judge); });
}

} // namespace ncvet
