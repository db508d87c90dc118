// The blocks that come after the current one, in the order in which the control executes them.
#include "analyzer/facts/blocks_ahead.h"

#include "analyzer/facts/lookahead.h"

namespace ncvet {

namespace {

/// So many blocks are read; jumps may lead round in a circle.
constexpr unsigned readable = 4096;

/// A statement that leaves control with the next block, calls, or jumps to one place.
bool isTold(const Item &item) {
  switch (item.kind) {
  case ItemKind::Assignment:
  case ItemKind::Output:
  case ItemKind::Instruction:
  case ItemKind::Parameters:
  case ItemKind::Definition:
  case ItemKind::Declaration:
  case ItemKind::Macro:
    return true;
  case ItemKind::Call:
    return !item.modal;
  case ItemKind::Jump:
    return item.condition == noExpression && item.nameEnd <= item.nameBegin &&
           (item.jump == JumpKind::Anywhere || item.jump == JumpKind::Forward ||
            item.jump == JumpKind::Backward);
  default:
    return false;
  }
}

/// Of a program that is not being executed.
constexpr CallSite unknownCaller;

/// The block's first code that leads elsewhere, or null.
const CodeInfo *leadingCode(const Dialect &dialect, const Block &block) {
  return findCode(dialect, block,
                  {Action::CallProgram, Action::CallLocal, Action::MacroCall, Action::MacroModal,
                   Action::ConditionalJump, Action::Return, Action::ProgramEnd,
                   Action::ProgramEndRewind});
}

} // namespace

BlocksAhead::BlocksAhead(const RuleContext &ctx)
    : unit_(&ctx.unit()), program_(&ctx.index().programAt(ctx.block().begin)), readIn_(unit_),
      own_(ctx.index()), caller_(ctx.caller()), left_(readable),
      // What a modal call runs comes between any two moves.
      way_(ctx.after().modalCalls || ctx.outcome().callsModally != Truth::No
               ? Way::Untold
               : follow(ctx.block())) {}

BlocksAhead::BlocksAhead(FileUnit &unit, const Block &from)
    : unit_(&unit), program_(&unit.index.programAt(from.begin)), readIn_(unit_), own_(unit.index),
      at_(from.next), caller_(&unknownCaller), left_(readable), way_(Way::GoesOn) {}

bool BlocksAhead::next(Block &block) {
  while (way_ == Way::GoesOn) {
    if (at_ >= program_->end || left_ == 0) {
      way_ = at_ >= program_->end && entered_.empty() && !caller_ ? Way::Over : Way::Untold;
      return false;
    }
    --left_;
    readIn_ = unit_;
    unit_->index.read(at_, block);
    if (block.kind == BlockKind::Tape && block.isEmpty()) {
      at_ = program_->end;
      continue;
    }
    at_ = block.next;
    if (block.isEmpty())
      continue;
    way_ = follow(block);
    return true;
  }
  return false;
}

bool BlocksAhead::nextAtWork(Block &block) {
  while (next(block)) {
    const CodeInfo *const code = leadingCode(*readIn_->dialect, block);
    const bool ends =
        code && (code->action == Action::ProgramEnd || code->action == Action::ProgramEndRewind);
    if (!code || ends || block.hasAny(readIn_->dialect->axisWords))
      return true;
  }
  return false;
}

/// Where control goes after the block.
BlocksAhead::Way BlocksAhead::follow(const Block &block) {
  at_ = block.next;
  const CodeInfo *const code = leadingCode(*unit_->dialect, block);
  const bool leads = code || llvm::any_of(block.items, [](const Item &item) {
                       return item.kind == ItemKind::Call || item.kind == ItemKind::Jump;
                     });
  if (!llvm::all_of(block.items, isTold) || (leads && block.skip >= 0))
    return Way::Untold;
  if (!leads)
    return Way::GoesOn;
  if (!code)
    return enter(block);
  switch (code->action) {
  case Action::ProgramEnd:
  case Action::ProgramEndRewind:
    // In a called program some controls go back to the caller there.
    return caller_ || !entered_.empty() ? Way::Untold : Way::Over;
  case Action::Return:
    return comeBack(block);
  case Action::CallProgram:
  case Action::CallLocal:
  case Action::MacroCall:
    return enter(block);
  default:
    return Way::Untold;
  }
}

BlocksAhead::Way BlocksAhead::goTo(FileUnit &unit, const ProgramInfo &program,
                                   std::optional<uint32_t> at) {
  if (!at)
    return Way::Untold;
  if (&unit.index != &own_)
    own_.reader(); // another file is looked at: nothing of this one may be taken over for it
  unit_ = &unit;
  program_ = &program;
  at_ = *at;
  return Way::GoesOn;
}

/// Back to the block after the call, or to the one that the return names.
BlocksAhead::Way BlocksAhead::comeBack(const Block &block) {
  std::optional<int64_t> target;
  bool told = true;
  unit_->references().words(block, unit_->source.text(), [&](const Reference &reference) {
    told &= reference.to == ReferredKind::Block;
    target = reference.number;
  });
  Entered back{};
  if (!entered_.empty()) {
    back = entered_.pop_back_val();
  } else if (caller_ && caller_->unit) {
    back = {caller_->unit, caller_->program, caller_->next, caller_->once};
    caller_ = caller_->before;
  } else {
    return Way::Untold;
  }
  if (!told)
    return Way::Untold;
  if (target)
    return goTo(
        *back.unit, *back.program,
        resolveBlock(back.unit->index, *back.program, Reference::toBlock(*target), back.next));
  return back.once ? goTo(*back.unit, *back.program, back.next) : Way::Untold;
}

/// Into the one program that the block calls, or to the one block to which it jumps.
BlocksAhead::Way BlocksAhead::enter(const Block &block) {
  llvm::SmallVector<Reference, 2> found;
  unit_->references().all(block, unit_->source.text(),
                          [&](const Reference &reference) { found.push_back(reference); });
  if (found.empty() || found.size() > 2)
    return Way::Untold;
  const Reference &to = found.front();
  const bool startsElsewhere = found.size() == 2;
  if (startsElsewhere && !(found[1].kind == ReferenceKind::First && found[1].inCalled))
    return Way::Untold;
  if (to.kind == ReferenceKind::Jump)
    return to.to == ReferredKind::Block || to.to == ReferredKind::Label
               ? goTo(*unit_, *program_, resolveBlock(unit_->index, *program_, to, block.begin))
               : Way::Untold;
  if (to.kind != ReferenceKind::Call)
    return Way::Untold;
  const bool counted = llvm::any_of(block.items, [](const Item &item) {
    return item.kind == ItemKind::Call && item.count != noExpression;
  });
  const Entered call{unit_, program_, block.next, to.runs == 1 && !counted};
  ReferredPlace place{unit_, program_, 0, 0};
  if (to.to == ReferredKind::Block || to.to == ReferredKind::Label) {
    const auto at = resolveBlock(unit_->index, *program_, to, block.begin);
    if (!at)
      return Way::Untold;
    place.begin = *at;
  } else {
    const auto resolved =
        unit_->project && to.to != ReferredKind::UntoldProgram && to.to != ReferredKind::UntoldBlock
            ? resolveProgram(*unit_->project, *unit_, to)
            : std::nullopt;
    if (!resolved || resolved->runs > 1)
      return Way::Untold;
    place = *resolved;
  }
  entered_.push_back(call);
  std::optional<uint32_t> at = place.begin;
  if (startsElsewhere)
    at = resolveBlock(place.unit->index, *place.program, found[1], place.program->body);
  return goTo(*place.unit, *place.program, at);
}

SourceRange BlocksAhead::range(const Block &block) const {
  return wordsRange(readIn_->source.id(), block);
}

bool namesAxes(const Dialect &dialect, const Block &block) {
  return block.hasAny(dialect.axisWords | dialect.incrementWords);
}

bool comesInTime(const RuleContext &ctx, unsigned furthest,
                 llvm::function_ref<bool(const Block &)> gives,
                 llvm::function_ref<bool(const Block &)> needs) {
  if (namesAxes(ctx.dialect(), ctx.block()))
    return false;
  BlocksAhead ahead(ctx);
  Block next;
  for (unsigned i = 0; i < furthest && ahead.next(next); ++i) {
    if (gives(next))
      return true;
    if (needs(next))
      return false;
  }
  return false;
}

} // namespace ncvet
