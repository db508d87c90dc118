// A dry run: what it comes to at each block, and why it stops there.
#include "interp/execute/execute.h"
#include "lsp/debug/dry_run.h"
#include "lsp/debug/operator_messages.h"

#include "llvm/Support/Path.h"

namespace ncvet::dap {

namespace {

/// What the user calls a running program or part of one.
std::string nameOf(const Region &region) {
  const auto line = [&](uint32_t at) {
    return std::to_string(region.unit.source.lines().lineOf(at));
  };
  switch (region.kind) {
  case RegionKind::LocalSubprogram:
    return "subprogram at line " + line(region.start);
  case RegionKind::Profile:
    return "profile at line " + line(region.start);
  case RegionKind::Section:
    return "repeated section at line " + line(region.start);
  case RegionKind::Main:
  case RegionKind::Subprogram:
    break;
  }
  const ProgramInfo &program = region.program;
  if (!program.name.empty())
    return program.name;
  if (program.number >= 0)
    return "O" + std::to_string(program.number);
  return llvm::sys::path::filename(region.unit.source.display()).str();
}

bool targetIsOpen(const Block &block, const Flow &flow) {
  if (flow.item < 0)
    return flow.kind == FlowKind::Jump && !flow.target.isConstant() && !flow.target.isVacant();
  const Item &item = block.items[size_t(flow.item)];
  if (item.jump == JumpKind::BySign || item.jump == JumpKind::ByValue)
    return !flow.choice.isConstant();
  return !item.arguments && item.jump != JumpKind::ToStart && !flow.target.isConstant() &&
         !flow.target.isVacant();
}

} // namespace

/// Puts the frames in order; true: a program or part of one begins.
bool DryRun::enter(const Arrival &arrival) {
  const Region &region = arrival.region;
  const RunningRegion key = keyOf(region);
  const size_t depth = arrival.depth;
  const bool isNew =
      frames_.size() <= depth || frames_[depth].identity != &region || frames_[depth].region != key;
  if (!isNew) {
    frames_.resize(depth + 1);
  } else {
    const bool fromCaller = frames_.size() == depth;
    frames_.resize(depth);
    if (fromCaller && depth > 0)
      frames_.back().state = last_;
    Frame frame;
    frame.unit = &region.unit;
    frame.program = &region.program;
    frame.region = key;
    frame.identity = &region;
    frame.name = nameOf(region);
    frame.next = region.start;
    frames_.push_back(std::move(frame));
  }
  frames_.back().begin = arrival.block.begin;
  frames_.back().end = arrival.block.end;
  passedFrom_ = std::exchange(frames_.back().next, arrival.block.next);
  return isNew;
}

/// Executes the block on a copy of the state: what it would do. True: something in it is open.
bool DryRun::look(const Arrival &arrival) {
  const Executor &executor = arrival.region.unit.executor();
  const Block &block = arrival.block;
  guard_ = block.items.empty() ? Truth::Yes : executor.guard(block, arrival.state);
  MachineState after = arrival.state;
  executor.execute(block, arrival.state, after, peek_, guard_ != Truth::No);
  const Flow &flow = peek_.flow;
  if (guard_ == Truth::Unknown || flow.kind == FlowKind::Branch)
    return true;
  if (flow.kind == FlowKind::Next)
    return false;
  return flow.condition == Truth::Unknown ||
         (flow.condition == Truth::Yes && flow.kind == FlowKind::Jump && targetIsOpen(block, flow));
}

void DryRun::tellReached(const Arrival &arrival, bool aloud) {
  const FileUnit &unit = arrival.region.unit;
  const auto [first, last] =
      program_.findingsWithin(unit.source.id(), arrival.block.begin, arrival.block.next);
  reached_.clear();
  for (size_t i = first; i < last; ++i)
    if (told_.insert(i).second)
      reached_.push_back(i);
  if (!aloud)
    return;
  for (const size_t i : reached_) {
    const ReachedFinding &finding = program_.findings()[i];
    observer_.said(finding.severity == Severity::Error ? "stderr" : "console", finding.text, unit,
                   finding.range.begin);
  }
}

/// What the program shows to the operator, of a block that is executed now.
void DryRun::tellMessages(const Arrival &arrival, Truth answer) const {
  if ((guard_ == Truth::Unknown ? answer : guard_) == Truth::No)
    return;
  const FileUnit &unit = arrival.region.unit;
  for (const OperatorMessage &message : messagesOf(unit, arrival.block, arrival.state))
    observer_.said("stdout", message.text, unit, message.offset);
}

/// Blocks without content before this one, which hold nothing but comments. Nothing is told after a
/// jump: there they are not passed.
void DryRun::tellPassed(const Arrival &arrival) const {
  const FileUnit &unit = arrival.region.unit;
  std::vector<OperatorMessage> messages;
  Block block;
  for (uint32_t at = passedFrom_; at < arrival.block.begin; at = block.next) {
    unit.reader->read(at, block);
    if (!block.isEmpty())
      return;
    llvm::append_range(messages, messagesOf(unit, block, arrival.state));
  }
  for (const OperatorMessage &message : messages)
    observer_.said("stdout", message.text, unit, message.offset);
}

std::optional<Stop> DryRun::whyStop(const Arrival &arrival, bool entered) {
  if (pause_) {
    goTo_.reset();
    return Stop{"pause", "", "", {}};
  }
  if (settings_.stopsNowhere)
    return std::nullopt;
  if (goTo_) {
    const FileUnit &unit = arrival.region.unit;
    if (*goTo_ != Breakpoints::Place(unit.source.id(), arrival.block.begin) || count_ <= goFrom_)
      return std::nullopt;
    goTo_.reset();
    return Stop{"goto", "", "", {}};
  }
  if (auto stop = atBreakpoint(arrival, entered, /*aloud=*/true))
    return stop;
  if (auto stop = atFinding())
    return stop;
  if (auto stop = atEvent(arrival))
    return stop;
  if (count_ == 1 && settings_.stopOnEntry)
    return Stop{"entry", "", "", {}};
  if (stepEnds())
    return Stop{"step", "", "", {}};
  return std::nullopt;
}

std::optional<Stop> DryRun::atBreakpoint(const Arrival &arrival, bool entered, bool aloud) {
  const FileUnit &unit = arrival.region.unit;
  Stop stop{"breakpoint", "", "", {}};
  const auto here = breakpoints_.atBlocks.find({unit.source.id(), arrival.block.begin});
  if (here != breakpoints_.atBlocks.end())
    for (Breakpoint &one : here->second) {
      if (!one.hit(arrival.state))
        continue;
      if (!one.isLog())
        stop.breakpoints.push_back(one.id());
      else if (aloud)
        observer_.said("console", one.message(arrival.state), unit, arrival.block.begin);
    }
  if (entered && !breakpoints_.atPrograms.empty()) {
    const ProgramInfo &program = arrival.region.program;
    const std::string name =
        program.number >= 0 ? std::to_string(program.number) : frames_.back().name;
    const auto called = breakpoints_.atPrograms.find(programKeyOf(name));
    if (called != breakpoints_.atPrograms.end() && arrival.region.kind != RegionKind::Section &&
        arrival.region.kind != RegionKind::Profile && called->second.hit(arrival.state)) {
      stop.reason = stop.breakpoints.empty() ? "function breakpoint" : stop.reason;
      stop.breakpoints.push_back(called->second.id());
    }
  }
  return stop.breakpoints.empty() ? std::nullopt : std::optional(std::move(stop));
}

std::optional<Stop> DryRun::atFinding() const {
  for (const size_t i : reached_) {
    const ReachedFinding &finding = program_.findings()[i];
    if ((finding.severity == Severity::Error && breakpoints_.filters.errors) ||
        (finding.severity == Severity::Warning && breakpoints_.filters.warnings))
      return Stop{"exception", "finding", finding.text, {}};
  }
  return std::nullopt;
}

/// What the block would do, where somebody wants to stop at such a thing.
std::optional<Stop> DryRun::atEvent(const Arrival &arrival) const {
  const ExceptionFilters &filters = breakpoints_.filters;
  const FileUnit &unit = arrival.region.unit;
  const auto said = [&] {
    std::string text;
    for (const OperatorMessage &message : messagesOf(unit, arrival.block, arrival.state))
      text += (text.empty() ? "" : ", ") + message.text;
    return text;
  };
  if (peek_.flow.kind == FlowKind::Alarm) {
    const std::string text = said();
    return Stop{"exception",
                "alarm",
                "the program stops itself with an alarm" + (text.empty() ? "" : ": " + text),
                {}};
  }
  if (filters.toolChange && peek_.kinds & bitOf(EventKind::ToolChange))
    return Stop{"exception", "tool change", "", {}};
  if (!filters.programStop)
    return std::nullopt;
  for (const CodeUse &use : peek_.codes) {
    const CodeInfo &code = unit.dialect->codes[use.code];
    if (code.action == Action::ProgramStop || code.action == Action::OptionalStop)
      return Stop{"exception", "program stop", code.name + " " + code.title, {}};
  }
  if (guard_ != Truth::No && stopsWithMessage(unit, arrival.block))
    return Stop{"exception", "program stop", said(), {}};
  return std::nullopt;
}

} // namespace ncvet::dap
