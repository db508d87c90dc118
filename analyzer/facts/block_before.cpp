// The block that was executed before the current one, as far as the text tells the way.
#include "analyzer/facts/block_before.h"

#include "analyzer/facts/called_blocks.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/references.h"

namespace ncvet {

namespace {

/// So many blocks are read: what comes before by more has no effect that a rule asks for.
constexpr unsigned readableBefore = 64;

/// The head of a program and its definitions do nothing.
bool onlyDeclares(const Block &block) {
  return block.words.empty() && !block.items.empty() &&
         llvm::all_of(block.items, [](const Item &item) {
           return item.kind == ItemKind::Parameters || item.kind == ItemKind::Definition ||
                  item.kind == ItemKind::Declaration || item.kind == ItemKind::Macro;
         });
}

} // namespace

BlocksBefore::BlocksBefore(const RuleContext &ctx)
    : dialect_(ctx.dialect()), unit_(&ctx.unit()),
      program_(&ctx.index().programAt(ctx.block().begin)), at_(ctx.block().begin),
      caller_(ctx.caller()), left_(readableBefore) {}

bool BlocksBefore::backInProgram(Block &block) {
  if (at_ <= program_->body)
    return false;
  const uint32_t limit = at_;
  at_ = std::max(program_->body, unit_->source.lines().lineBegin(at_ - 1));
  unit_->index.read(at_, block);
  if (block.isEmpty() || block.next <= limit)
    return true;
  left_ = 1; // where blocks span lines this is none: nothing more is told
  return false;
}

bool BlocksBefore::enter(const Block &block, bool &calls) {
  llvm::SmallVector<Reference, 2> named;
  unit_->references().all(block, unit_->source.text(), [&](const Reference &reference) {
    if (reference.kind == ReferenceKind::Call)
      named.push_back(reference);
  });
  calls = !named.empty() || entersProgram(block);
  const bool known = named.size() == 1 && (named[0].to == ReferredKind::Program ||
                                           named[0].to == ReferredKind::NamedProgram);
  if (!known || !unit_->project)
    return false;
  const auto place = resolveProgram(*unit_->project, *unit_, named[0]);
  if (!place)
    return false;
  entered_.push_back({unit_, program_, at_});
  unit_ = place->unit;
  program_ = place->program;
  at_ = program_->end;
  return true;
}

bool BlocksBefore::next(Block &block) {
  for (; left_ > 0; --left_) {
    if (!backInProgram(block)) {
      if (!entered_.empty()) { // the begin of a called program: on before its call
        const Place back = entered_.pop_back_val();
        unit_ = back.unit;
        program_ = back.program;
        at_ = back.at;
        continue;
      }
      if (!caller_ || !caller_->unit)
        return false;
      unit_ = caller_->unit;
      program_ = caller_->program;
      at_ = caller_->next;
      caller_ = caller_->before;
      if (!backInProgram(block)) // the call
        return false;
      continue;
    }
    if (block.isEmpty() || onlyDeclares(block))
      continue;
    bool calls = false;
    if (enter(block, calls))
      continue;
    if (calls)
      return false;
    const bool onlyReturns =
        findCode(dialect_, block, {Action::Return}) && !block.hasAny(dialect_.axisWords);
    if (!onlyReturns)
      return true;
  }
  return false;
}

} // namespace ncvet
