// Where control goes after a block.
#include "analyzer/flow/block_flow.h"

#include "analyzer/program/references.h"

namespace ncvet {

/// Jumps in the text of another control are not seen: an end there may be passed.
bool BlockFlow::mayBePassed(const Step &step) {
  const FileUnit &unit = step.unit();
  const ProgramInfo &program = step.region().program;
  const auto [known, fresh] = foreignJumps_.try_emplace({unit.source.id(), program.begin});
  if (fresh)
    known->second = namesForeignJump(unit, program);
  return known->second;
}

void BlockFlow::leave(Step &step) {
  if (step.outcome.foreign && step.outcome.flow.kind != FlowKind::Next && mayBePassed(step))
    step.activation.add(step.block.next, step.live);
  switch (step.outcome.flow.kind) {
  case FlowKind::Next:
    return step.goOn();
  case FlowKind::Jump:
    return jumps_.jump(step);
  case FlowKind::Branch:
    return jumps_.branch(step);
  case FlowKind::Structure:
    return structures_.bracket(step);
  case FlowKind::Repeat:
    return sections_.repeat(step);
  case FlowKind::LoopBegin:
  case FlowKind::LoopEnd:
    return loops_.loop(step);
  case FlowKind::CallModal:
    return calls_.beginModalCall(step);
  case FlowKind::Call:
  case FlowKind::CallLocal:
  case FlowKind::CallNamed:
    return calls_.call(step);
  case FlowKind::Contour:
    return contours_.contour(step);
  case FlowKind::Profile:
    return contours_.profile(step);
  case FlowKind::End:
    return endProgram(step);
  case FlowKind::Alarm:
    return;
  case FlowKind::Return:
    return returnFrom(step);
  }
}

void BlockFlow::endProgram(Step &step) {
  const Region &region = step.region();
  if (region.kind == RegionKind::Main || region.kind == RegionKind::Profile || region.depth() == 0)
    return;
  run_.issue(FlowIssue::EndInSubprogram, step, step.flowRange());
  if (region.unit.dialect->endReturns)
    step.activation.exit(std::move(step.live));
}

void BlockFlow::returnFrom(Step &step) {
  const Region &region = step.region();
  const Value &number = step.outcome.flow.target;
  const int64_t target = number.isConstant() ? int64_t(number.number.value()) : notSet;
  if (region.kind != RegionKind::Main)
    return step.activation.exit(std::move(step.live), target);
  if (target == notSet)
    return run_.issue(FlowIssue::ReturnInMain, step, step.flowRange());
  // M99 P in a main program is a jump.
  run_.used.numbers.insert(target);
  if (const auto offset =
          resolveBlock(region.unit.index, region.program, Reference::toBlock(target), step.at))
    loops_.goTo(step, *offset, std::move(step.live), true);
  else
    run_.issue(FlowIssue::UnknownBlock, step, step.flowRange());
}

} // namespace ncvet
