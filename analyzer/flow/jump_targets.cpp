// The blocks that the targets of a jump name.
#include "analyzer/flow/jump_targets.h"

#include "interp/evaluate/expression.h"

namespace ncvet {

namespace {

/// A jump to a number that is not known may go to any block with a number, when these are few.
constexpr size_t maxComputedTargets = 64;

} // namespace

void JumpTargets::tooMany(const Step &step) {
  run_.cut(step.blockRange(), "a computed jump may lead to too many blocks");
}

void JumpTargets::anywhere(const Step &step) {
  const llvm::ArrayRef<NumberedBlock> all = step.unit().index.numbers(step.region().program);
  if (all.size() > maxComputedTargets)
    return tooMany(step);
  const std::vector<NumberedBlock> targets(all.begin(), all.end());
  // A menu leads to some of them, after which the program states what it needs: in which state it
  // would come to the others is no matter.
  Live there = step.live;
  there.state = unknownState(*step.unit().dialect);
  for (const NumberedBlock &target : targets) {
    run_.used.numbers.insert(target.number);
    loops_.goTo(step, target.offset, there, false);
  }
}

/// What the programs of another file name is no label of the main file.
void JumpTargets::useLabel(const FileUnit &unit, std::string key) {
  if (&unit == &run_.unit)
    run_.used.labels.insert(std::move(key));
}

/// A target that is put together from texts: any label that begins as they do.
void JumpTargets::anyLabel(const Step &step, const Argument &target, JumpKind kind) {
  const FileUnit &unit = step.unit();
  run_.fork(step.activation, {unit.source.id(), target.begin, target.end});
  llvm::StringRef text = unit.source.text(target.begin, target.end);
  const bool literal = text.consume_front("\"");
  const std::string begin =
      literal ? unit.reader->labelKey(text.take_until([](char c) { return c == '"'; })) : "";
  std::vector<uint32_t> places;
  for (const auto &label : unit.index.labels(step.region().program)) {
    if (!label.getKey().startswith(begin))
      continue;
    useLabel(unit, label.getKey().str());
    for (const uint32_t place : label.getValue())
      if (kind == JumpKind::Forward ? place > step.at
                                    : kind != JumpKind::Backward || place <= step.at)
        places.push_back(place);
  }
  llvm::sort(places);
  if (places.size() > maxComputedTargets)
    return tooMany(step);
  for (const uint32_t place : places)
    loops_.goTo(step, place, step.live, false);
}

void JumpTargets::note(const Step &step) {
  const Block &block = step.block;
  for (const Item &item : block.items) {
    if (item.kind != ItemKind::Jump || item.nameEnd > item.nameBegin)
      continue;
    for (const Argument &target : block.argumentsOf(item)) {
      if (target.kind == ArgumentKind::Label) {
        const llvm::StringRef text = step.unit().source.text(target.begin, target.end);
        useLabel(step.unit(), step.unit().reader->labelKey(text));
      } else if (target.kind == ArgumentKind::BlockNumber) {
        const Value number = evaluate(block, target.expression, MachineState(), nullptr);
        if (number.isConstant())
          run_.used.numbers.insert(std::llround(number.number.value()));
      }
    }
  }
}

/// The block that a number names; `computed`: the number is not known, and the rest is done.
std::optional<uint32_t> JumpTargets::resolveNumber(const Step &step, FileUnit &unit,
                                                   const ProgramInfo &program,
                                                   const Argument &target, uint32_t from,
                                                   JumpKind kind, bool &computed) {
  const Block &block = step.block;
  const Value number = target.kind == ArgumentKind::Empty
                           ? Value::vacant()
                           : evaluate(block, target.expression, step.live.state, nullptr);
  if (target.kind == ArgumentKind::BlockNumber && number.isConstant()) {
    const Reference reference =
        Reference::toBlock(std::llround(number.number.value()), searchOf(kind));
    run_.used.numbers.insert(reference.number);
    return resolveBlock(unit.index, program, reference, from);
  }
  computed = true;
  run_.issue(number.isVacant() ? FlowIssue::NoTarget : FlowIssue::ComputedTarget, step,
             {step.unit().source.id(), target.begin, target.end});
  if (number.isVacant() || &unit != &step.unit())
    return std::nullopt;
  const Step there{step.activation, step.live,    from,        step.before,
                   block,           step.outcome, step.stretch};
  if (target.expression < block.expressions.size() && block.expressions[target.expression].bad)
    anyLabel(there, target, kind);
  else
    anywhere(there);
  return std::nullopt;
}

std::optional<uint32_t> JumpTargets::resolve(const Step &step, FileUnit &unit,
                                             const ProgramInfo &program, const Argument &target,
                                             uint32_t from, JumpKind kind) {
  const SourceFile &source = step.unit().source;
  std::optional<uint32_t> offset;
  if (target.kind == ArgumentKind::Label) {
    const Reference reference =
        Reference::toLabel(source.text(target.begin, target.end), searchOf(kind));
    useLabel(unit, unit.reader->labelKey(reference.text));
    offset = resolveBlock(unit.index, program, reference, from);
  } else if (target.kind == ArgumentKind::Name) {
    return std::nullopt; // no place at all: how it is written is a rule's business
  } else {
    bool computed = false;
    offset = resolveNumber(step, unit, program, target, from, kind, computed);
    if (computed)
      return std::nullopt;
  }
  if (!offset && kind != JumpKind::IfFound)
    run_.issue(FlowIssue::UnknownBlock, step, {source.id(), target.begin, target.end});
  return offset;
}

} // namespace ncvet
