// The programs that calls name.
#include "analyzer/flow/callees.h"

#include "analyzer/program/references.h"

namespace ncvet {

namespace {

Reference referenceTo(ReferredKind kind, llvm::StringRef name) {
  Reference reference;
  reference.to = kind;
  reference.text = name;
  return reference;
}

Reference referenceTo(ReferredKind kind, int64_t number) {
  Reference reference;
  reference.to = kind;
  reference.number = number;
  return reference;
}

/// The callee begins where the program does.
bool enter(Callee &callee, const std::optional<ReferredPlace> &place) {
  if (place) {
    callee.unit = place->unit;
    callee.program = place->program;
    callee.start = place->begin;
  }
  return place.has_value();
}

} // namespace

std::optional<Callee> Callees::find(const Step &step) {
  const Flow &flow = step.outcome.flow;
  const Callee callee{&step.unit(), &step.region().program, 0};
  if (flow.kind == FlowKind::CallNamed || (flow.kind == FlowKind::CallModal && flow.item >= 0))
    return named(step, step.block.items[size_t(flow.item)], callee);
  if (flow.code != noCode && callee.unit->dialect->codes[flow.code].elsewhere)
    return std::nullopt;
  if (flow.target.isVacant() && step.block.nameEnd > step.block.nameBegin)
    return headed(step, callee);
  if (flow.target.isVacant())
    return missing(FlowIssue::NoTarget, step, step.flowRange());
  if (!flow.target.isConstant()) {
    run_.used.anyNumber |= flow.kind == FlowKind::CallLocal;
    return missing(FlowIssue::ComputedTarget, step, step.flowRange());
  }
  return flow.kind == FlowKind::CallLocal ? local(step, callee) : numbered(step, callee);
}

std::optional<Callee> Callees::named(const Step &step, const Item &item, Callee callee) {
  const FileUnit &unit = step.unit();
  const Flow &flow = step.outcome.flow;
  const uint64_t place = uint64_t(unit.source.id()) << 32 | item.nameBegin;
  const bool hasName = item.nameEnd > item.nameBegin;
  if (hasName && item.positional)
    if (const auto known = bracketed_.find(place); known != bracketed_.end()) {
      run_.opaque = true; // what is named here was noted when it was found
      return known->second;
    }
  std::string name = unit.source.text(item.nameBegin, item.nameEnd).str();
  SourceRange range{unit.source.id(), item.nameBegin, item.nameEnd};
  if (!hasName) {
    range = step.flowRange();
    if (!flow.target.isConstant()) // the value of a variable is the name
      return missing(FlowIssue::ComputedTarget, step, range);
    name = std::to_string(std::llround(flow.target.number.value()));
  }
  run_.used.names.insert(llvm::StringRef(name).upper());
  if (!item.positional)
    return external(step, item, name, range, callee);
  if (findBracketed(callee, name)) {
    if (hasName)
      bracketed_.try_emplace(place, callee);
    return callee;
  }
  // Whoever calls this subprogram may lie elsewhere, and have what it calls beside it.
  if (run_.callerUnknown)
    return std::nullopt;
  return missing(FlowIssue::UnknownProgram, step, range);
}

/// A program with a name, in this file or another.
std::optional<Callee> Callees::external(const Step &step, const Item &item, llvm::StringRef name,
                                        SourceRange range, Callee callee) {
  FileUnit &unit = step.unit();
  if (enter(callee,
            resolveProgram(run_.project, unit, referenceTo(ReferredKind::NamedProgram, name))))
    return callee;
  const Defined *known = unit.index.definition(step.region().program, name);
  const CodeIndex own = unit.dialect->keyword(name);
  if (item.external || (known && known->kind == ItemKind::Macro) ||
      (own != noCode && unit.dialect->codes[own].isProgram) ||
      run_.project.liesElsewhere(unit, name))
    return std::nullopt; // it need not lie here
  return missing(FlowIssue::UnknownProgram, step, range);
}

/// `M98 <NAME>`: a program whose header is the name.
std::optional<Callee> Callees::headed(const Step &step, Callee callee) {
  const Block &block = step.block;
  FileUnit &unit = step.unit();
  const llvm::StringRef name = unit.source.text(block.nameBegin, block.nameEnd);
  run_.used.names.insert(name.upper());
  if (!enter(callee,
             resolveProgram(run_.project, unit, referenceTo(ReferredKind::NamedProgram, name))))
    return missing(FlowIssue::UnknownProgram, step, step.flowRange());
  return callee;
}

/// A part of this program that begins at a numbered block.
std::optional<Callee> Callees::local(const Step &step, Callee callee) {
  callee.number = int64_t(step.outcome.flow.target.number.value());
  run_.used.numbers.insert(callee.number);
  const auto offset = resolveBlock(step.unit().index, *callee.program,
                                   referenceTo(ReferredKind::Block, callee.number), step.at);
  if (!offset)
    return missing(FlowIssue::UnknownBlock, step, step.flowRange());
  callee.start = *offset;
  callee.kind = RegionKind::LocalSubprogram;
  if (&step.unit() == &run_.unit)
    run_.used.localSubprograms.insert(callee.start);
  return callee;
}

/// A program with a number, perhaps from one of its blocks on.
std::optional<Callee> Callees::numbered(const Step &step, Callee callee) {
  const Flow &flow = step.outcome.flow;
  callee.number = int64_t(flow.target.number.value());
  run_.used.programs.insert(callee.number);
  Reference reference = referenceTo(ReferredKind::Program, callee.number);
  reference.packed = flow.packed;
  const std::optional<ReferredPlace> place = resolveProgram(run_.project, step.unit(), reference);
  if (place && place->runs) {
    callee.repeat = Value::of(double(place->runs));
    callee.number = place->program->number;
    run_.used.programs.insert(callee.number);
  }
  if (!enter(callee, place))
    return missing(FlowIssue::UnknownProgram, step, step.flowRange());
  if (flow.startAt.isConstant()) {
    const auto first = int64_t(flow.startAt.number.value());
    if (callee.unit == &run_.unit)
      run_.used.numbers.insert(first);
    if (const auto offset =
            resolveBlock(callee.unit->index, *callee.program,
                         referenceTo(ReferredKind::Block, first), callee.program->begin))
      callee.start = *offset;
  }
  return callee;
}

bool Callees::findBracketed(Callee &callee, llvm::StringRef name) {
  if (!enter(callee, resolveProgram(run_.project, *callee.unit,
                                    referenceTo(ReferredKind::Subprogram, name))))
    return false;
  if (callee.unit == &run_.unit)
    run_.used.bracketed.insert(callee.start);
  callee.kind = RegionKind::LocalSubprogram;
  return true;
}

std::optional<Callee> Callees::findModal(FileUnit &unit, const ModalCall &call, const Block &made,
                                         const Item *&item) {
  Callee callee{&unit, nullptr, 0, RegionKind::Subprogram,
                call.program >= 0 ? call.program : notSet};
  Reference reference = referenceTo(ReferredKind::Program, call.program);
  if (call.program < 0) {
    for (const Item &one : made.items)
      if (one.kind == ItemKind::Call && one.modal)
        item = &one;
    if (!item)
      return std::nullopt;
    const SourceFile &maker = run_.project.sources().get(call.file);
    reference = referenceTo(ReferredKind::NamedProgram, maker.text(item->nameBegin, item->nameEnd));
  }
  if (!enter(callee, resolveProgram(run_.project, unit, reference)))
    return std::nullopt;
  return callee;
}

} // namespace ncvet
