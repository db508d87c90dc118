// Sections of a program that a block runs again.
#include "analyzer/flow/sections.h"

#include "analyzer/flow/endings.h"
#include "analyzer/program/block_reading.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {

namespace {

/// Last block of a section that only its begin names: the one with the end label, or the one before
/// the repeating block.
uint32_t endOfSection(const FileUnit &unit, uint32_t first, uint32_t at) {
  uint32_t last = first;
  for (const Block &block : blocks(*unit.reader, first, at)) {
    last = block.begin;
    if (block.hasLabel() &&
        unit.dialect->lexical.endLabel ==
            unit.reader->labelKey(unit.source.text(block.labelBegin, block.labelEnd)))
      break;
  }
  return last;
}

} // namespace

/// The section that the block names; none, with an issue, when it is not there.
std::optional<Sections::Bounds> Sections::boundsOf(const Step &step, const Item &item) {
  FileUnit &unit = step.unit();
  const ProgramInfo &program = step.region().program;
  const llvm::ArrayRef<Argument> places = step.block.argumentsOf(item);
  std::optional<uint32_t> first, last;
  if (!places.empty())
    first = targets_.resolve(step, unit, program, places[0], step.at, item.jump);
  if (!first)
    return std::nullopt;
  if (places.size() > 1)
    last = targets_.resolve(step, unit, program, places[1], *first ? *first - 1 : 0,
                            JumpKind::Anywhere);
  if (places.size() > 1 && !last)
    return std::nullopt;
  if (item.single)
    last = first;
  if (!last)
    last = endOfSection(unit, *first, step.at);
  return Bounds{*first, *last};
}

/// Whether the section cannot be repeated as it is named; then the rest is done.
bool Sections::isWrong(Step &step, const Item &item, const Bounds &bounds) {
  const auto [first, last] = bounds;
  const bool heads = first == step.at;                           // the body follows the block
  if (item.count == noExpression && last == step.at && !heads) { // without a count, and to itself
    if (!holdsWayOut(step.unit(), first, step.at))
      run_.issue(FlowIssue::EndlessLoop, step, step.flowRange());
    loops_.backTo(step, first, std::move(step.live), false);
    return true;
  }
  const bool two = step.block.argumentsOf(item).size() > 1;
  if (last < first || (two && first < step.at && step.at <= last && !heads)) {
    run_.issue(FlowIssue::RepeatBounds, step, step.flowRange());
    step.goOn();
    return true;
  }
  return false;
}

/// What is wrong with a section that is repeated all the same: it runs from `start` to `end`.
void Sections::report(const Step &step, const Bounds &bounds, uint32_t start, uint32_t end) {
  FileUnit &unit = step.unit();
  const SourceRange where = step.flowRange();
  for (const auto &[head, past] : run_.shape(unit, step.region().program).past)
    if ((head < bounds.first && bounds.first < past && past <= end) ||
        (bounds.first < head && head < end && end < past))
      run_.issue(FlowIssue::RepeatOverlap, step, where, {unit.source.id(), head, head + 1});
  const unsigned deepest = unit.dialect->limits.repeatDepth;
  if (deepest && bodies_.runningSections() >= deepest)
    run_.issue(FlowIssue::TooDeep, step, where);
  const unsigned levels = unit.dialect->limits.callDepth;
  if (unit.dialect->facts->limits.repeatsTakeLevel && levels && step.region().depth() + 1 > levels)
    run_.issue(FlowIssue::TooDeep, step, where);
  // Where the end comes first the rule says so at the end.
  if (!unit.dialect->facts->program.endCutsRepeats && holdsEnd(unit, start, end))
    run_.issue(FlowIssue::RepeatBounds, step, where);
}

void Sections::repeat(Step &step) {
  const Region &region = step.region();
  FileUnit &unit = step.unit();
  const Flow &flow = step.outcome.flow;
  const Item &item = step.block.items[size_t(flow.item)];
  const auto bounds = boundsOf(step, item);
  if (!bounds)
    return step.goOn();
  if (isWrong(step, item, *bounds))
    return;
  const bool heads = bounds->first == step.at;
  Block last;
  unit.reader->read(bounds->last, last);
  const uint32_t end = last.next;
  const uint32_t start = heads ? step.block.next : bounds->first;
  report(step, *bounds, start, end);
  // Nested repeats may begin at one block; a section that holds its own repeat has no end.
  if ((!heads && start <= step.at && step.at < end) ||
      bodies_.isRunning(unit, start, RegionKind::Section, end) || bodies_.isDeep() ||
      start >= end) {
    if (start < end)
      run_.issue(FlowIssue::Recursion, step, step.flowRange(),
                 {unit.source.id(), start, start + 1});
    return step.goOn();
  }
  Passes passes(step);
  if (heads)
    passes.next = end;
  passes.setCount(item.count == noExpression ? Value::of(1) : flow.repeat);
  step.live.path = run_.lengthen(step.live.path, PathNode::Kind::LoopPass, step.flowRange());
  Region body{unit, region.program, start, RegionKind::Section, region.caller};
  body.stopAt = end;
  passes_.run(step, body, passes);
}

} // namespace ncvet
