// The programs that calls name.
#include "analyzer/flow/callees.h"

namespace ncvet {

namespace {

/// First block after the bracket that opens the subprogram `label`, and the program that holds it.
std::optional<uint32_t> subprogramBody(const FileUnit &unit, llvm::StringRef label,
                                       const ProgramInfo *&program) {
  for (const ProgramInfo &one : unit.index.programs())
    if (const auto at = unit.index.label(one, label, one.begin)) {
      Block block;
      unit.reader->read(*at, block);
      program = &one;
      return block.next;
    }
  return std::nullopt;
}

} // namespace

std::optional<Callee> Callees::find(const Step &step) {
  const Flow &flow = step.outcome.flow;
  const Callee callee{&step.unit(), &step.region().program, 0};
  if (flow.kind == FlowKind::CallNamed || (flow.kind == FlowKind::CallModal && flow.item >= 0))
    return named(step, step.block.items[size_t(flow.item)], callee);
  if (flow.target.isVacant())
    return missing(FlowIssue::NoTarget, step, step.flowRange());
  if (!flow.target.isConstant())
    return missing(FlowIssue::ComputedTarget, step, step.flowRange());
  return flow.kind == FlowKind::CallLocal ? local(step, callee) : numbered(step, callee);
}

std::optional<Callee> Callees::named(const Step &step, const Item &item, Callee callee) {
  const FileUnit &unit = step.unit();
  const Flow &flow = step.outcome.flow;
  std::string name = unit.source.text(item.nameBegin, item.nameEnd).str();
  SourceRange range{unit.source.id(), item.nameBegin, item.nameEnd};
  if (name.empty()) {
    range = step.flowRange();
    if (!flow.target.isConstant()) // the value of a variable is the name
      return missing(FlowIssue::ComputedTarget, step, range);
    name = std::to_string(std::llround(flow.target.number.value()));
  }
  run_.used.names.insert(llvm::StringRef(name).upper());
  if (!item.positional)
    return external(step, item, name, range, callee);
  if (findBracketed(callee, name))
    return callee;
  // Whoever calls this subprogram may lie elsewhere, and have what it calls beside it.
  if (run_.callerUnknown)
    return std::nullopt;
  return missing(FlowIssue::UnknownProgram, step, range);
}

/// A program with a name, in this file or another.
std::optional<Callee> Callees::external(const Step &step, const Item &item, llvm::StringRef name,
                                        SourceRange range, Callee callee) {
  FileUnit &unit = step.unit();
  std::tie(callee.unit, callee.program) = run_.project.findProgram(unit, name);
  if (callee.program) {
    callee.start = callee.program->body;
    return callee;
  }
  const Defined *known = unit.index.definition(step.region().program, name);
  const CodeIndex own = unit.dialect->keyword(name);
  if (item.external || (known && known->kind == ItemKind::Macro) ||
      (own != noCode && unit.dialect->codes[own].isProgram))
    return std::nullopt; // it need not lie here
  return missing(FlowIssue::UnknownProgram, step, range);
}

/// A part of this program that begins at a numbered block.
std::optional<Callee> Callees::local(const Step &step, Callee callee) {
  callee.number = int64_t(step.outcome.flow.target.number.value());
  run_.used.numbers.insert(callee.number);
  const auto offset = step.unit().index.block(*callee.program, callee.number, step.at);
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
  std::tie(callee.unit, callee.program) = run_.project.findProgram(step.unit(), callee.number);
  if (!callee.program)
    return missing(FlowIssue::UnknownProgram, step, step.flowRange());
  callee.start = callee.program->body;
  if (flow.startAt.isConstant()) {
    const auto first = int64_t(flow.startAt.number.value());
    if (callee.unit == &run_.unit)
      run_.used.numbers.insert(first);
    if (const auto offset = callee.unit->index.block(*callee.program, first, callee.program->begin))
      callee.start = *offset;
  }
  return callee;
}

bool Callees::findBracketed(Callee &callee, llvm::StringRef name) {
  auto body = subprogramBody(*callee.unit, name, callee.program);
  if (!body) {
    std::tie(callee.unit, callee.program) = run_.project.findProgram(*callee.unit, name);
    if (callee.program)
      body = subprogramBody(*callee.unit, name, callee.program);
  }
  if (!body)
    return false;
  if (callee.unit == &run_.unit)
    run_.used.bracketed.insert(*body);
  callee.start = *body;
  callee.kind = RegionKind::LocalSubprogram;
  return true;
}

std::optional<Callee> Callees::findModal(FileUnit &unit, const ModalCall &call, const Block &made,
                                         const Item *&item) {
  Project::Found found{nullptr, nullptr};
  if (call.program >= 0) {
    found = run_.project.findProgram(unit, call.program);
  } else {
    for (const Item &one : made.items)
      if (one.kind == ItemKind::Call && one.modal)
        item = &one;
    if (!item)
      return std::nullopt;
    const SourceFile &maker = run_.project.sources().get(call.file);
    found = run_.project.findProgram(unit, maker.text(item->nameBegin, item->nameEnd));
  }
  if (!found.second)
    return std::nullopt;
  return Callee{found.first, found.second, found.second->body, RegionKind::Subprogram,
                call.program >= 0 ? call.program : notSet};
}

} // namespace ncvet
