// Tests the conditions of a dialect's table against a block and the state before it.
#include "interp/evaluate/condition.h"

#include "interp/evaluate/formula.h"
#include "interp/evaluate/tool_data.h"
#include "interp/state/event.h"

#include <algorithm>
#include <cmath>

namespace ncvet {

bool breaks(const ValueTest &test, const Word &word, const ConditionContext &context) {
  if (word.has(wordNoValue))
    return false;
  if (word.isNumber()) {
    if (test.point == PointRule::Required && !word.has(wordPoint))
      return true;
    if (test.point == PointRule::Forbidden && word.has(wordPoint))
      return true;
  }
  const Interval value = wordValue(word, context.block, context.before);
  if (value.isUnknown())
    return false;
  if (test.minExclusive ? value.hi <= test.min : value.hi < test.min)
    return true;
  if (test.maxExclusive ? value.lo >= test.max : value.lo > test.max)
    return true;
  if (!value.isConstant())
    return false;
  if (test.integer && value.value() != std::floor(value.value()))
    return true;
  return !test.oneOf.empty() &&
         std::find(test.oneOf.begin(), test.oneOf.end(), value.value()) == test.oneOf.end();
}

namespace {

bool blockHasMember(const ConditionContext &context, GroupIndex group, uint64_t members) {
  for (const CodeUse &use : context.codes) {
    // A variant is its code, whatever group it has itself.
    const CodeInfo &info = context.dialect.codes[context.dialect.codes[use.code].base];
    if (info.group == group && members >> info.bit & 1)
      return true;
  }
  return false;
}

bool blockHasCode(const ConditionContext &context, CodeIndex wanted) {
  // A variant is its code.
  const CodeIndex base = context.dialect.codes[wanted].base;
  return llvm::any_of(context.codes, [&](const CodeUse &use) {
    return context.dialect.codes[use.code].base == base;
  });
}

/// Whether words are before the code, or after it, as the condition wants.
bool isAround(const Condition &condition, const CodeInfo *code, const ConditionContext &context) {
  for (const CodeUse &use : context.codes) {
    if (!code || !use.word || context.dialect.codes[use.code].base != code->base)
      continue;
    bool before = !condition.before, after = !condition.after;
    AddressMask later = 0;
    const Word *next = nullptr;
    for (const Word &word : context.block.words) {
      before |= word.offset < use.word->offset && (condition.before & maskOf(word.address));
      if (word.offset <= use.word->offset)
        continue;
      later |= maskOf(word.address);
      if (!next || word.offset < next->offset)
        next = &word;
    }
    after |= (condition.after & later) != 0;
    if (condition.next && !(next && condition.next & maskOf(next->address)))
      return false;
    return before && after && !(condition.noneAfter & later);
  }
  return false;
}

bool optionHolds(const std::pair<std::string, std::vector<std::string>> &option,
                 const ConditionContext &context) {
  std::optional<llvm::StringRef> value = context.machine.option(option.first);
  if (!value) {
    const auto found = context.dialect.options.find(option.first);
    if (found != context.dialect.options.end() && !found->second.empty())
      value = llvm::StringRef(found->second);
  }
  // `null` in the table: nothing is known of the option.
  return llvm::is_contained(option.second, value ? value->str() : std::string());
}

} // namespace

bool holds(const Condition &condition, const CodeInfo *code, const ConditionContext &context) {
  const AddressMask present = context.block.addresses;
  if ((condition.has & ~present) || (condition.lacks & present) ||
      (condition.any && !(condition.any & present)))
    return false;
  for (const auto &[group, members] : condition.active)
    if (context.before.group(group) & ~members)
      return false;
  for (const auto &[group, members] : condition.with)
    if (!blockHasMember(context, group, members))
      return false;
  for (const auto &[group, members] : condition.without)
    if (blockHasMember(context, group, members))
      return false;
  if (!condition.withCode.empty() &&
      llvm::none_of(condition.withCode, [&](CodeIndex c) { return blockHasCode(context, c); }))
    return false;
  if (llvm::any_of(condition.withoutCode, [&](CodeIndex c) { return blockHasCode(context, c); }))
    return false;
  if (condition.first && code && code->group != noGroup &&
      (context.before.group(code->group) >> code->bit & 1))
    return false;
  if (condition.pending &&
      (context.before.pendingCycle == noCode ||
       context.dialect.codes[context.before.pendingCycle].cycle != *condition.pending))
    return false;
  for (const auto &option : condition.options)
    if (!optionHolds(option, context))
      return false;
  for (const ValueTest &test : condition.broken) {
    bool broken = false;
    for (const Word &word : context.block.words)
      broken |= word.address == test.address && breaks(test, word, context);
    if (!broken)
      return false;
  }
  const MachineState &before = context.before;
  if ((condition.on & ~before.switches.areOn(condition.on)) ||
      before.switches.mayBeOn(condition.off))
    return false;
  if ((condition.before || condition.after || condition.next || condition.noneAfter) &&
      !isAround(condition, code, context))
    return false;
  constexpr uint8_t turning = spindleCw | spindleCcw;
  if (condition.spindleTurns &&
      (*condition.spindleTurns ? (before.spindle & ~turning) || !before.spindle
                               : before.spindle != spindleOff))
    return false;
  if (!condition.toolKind.empty() || !condition.otherToolKind.empty()) {
    const ToolData *tool = toolInUse(context.machine, before);
    if (!tool || tool->kind.empty() ||
        (!condition.toolKind.empty() && !llvm::is_contained(condition.toolKind, tool->kind)) ||
        llvm::is_contained(condition.otherToolKind, tool->kind))
      return false;
  }
  return condition.formula.empty() ||
         (code && truthOf(condition.formula, *code, context) == Truth::Yes);
}

} // namespace ncvet
