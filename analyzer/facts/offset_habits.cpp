// Which offset numbers the tools of a file have, read from its words.
#include "analyzer/facts/offset_habits.h"

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/wanted_blocks.h"

namespace ncvet {
namespace {

constexpr size_t fewTools = 2;  ///< make a habit of lengths
constexpr size_t manyTools = 3; ///< make a sure one, and one of stations
constexpr int64_t step = 10;    ///< a second length of a tool often lies tens above its first one

bool isLength(const Word &word) { return word.address == letterAddress('H'); }

/// Whether a length may be a second one of the tool.
bool isFurtherLength(const Word &word, int64_t tool) {
  return (int64_t(word.value()) - tool) % step == 0;
}

bool subtractsOne(const RuleContext &ctx, const ProgramInfo &program) {
  std::set<int64_t> plus, minus;
  for (const Block &block : blocksNaming(ctx.index(), program, ctx.dialect(),
                                         {Action::LengthPositive, Action::LengthNegative})) {
    const CodeInfo *const code =
        findCode(ctx.dialect(), block, {Action::LengthPositive, Action::LengthNegative});
    const Word *const number = block.find(letterAddress('H'));
    if (code)
      (code->action == Action::LengthPositive ? plus : minus)
          .insert(number && number->isNumber() ? int64_t(number->value()) : -1);
  }
  return minus.size() == 1 && plus.size() >= fewTools && !plus.count(*minus.begin());
}

bool isOnlyOne(int64_t tool, int64_t offset, const RuleContext &ctx) {
  std::set<int64_t> own;
  for (const ProgramInfo &program : ctx.index().programs())
    for (const Block &block : blocksWith(ctx.index(), program, maskOf(letterAddress('T')))) {
      const Word *const word = block.find(letterAddress('T'));
      if (!word || !word->isNumber() || word->value() < 100 || word->value() > 9999)
        continue;
      const auto whole = int64_t(word->value());
      if (whole % 100 == 0)
        continue;
      if (whole / 100 == whole % 100)
        own.insert(whole % 100);
      else if (whole / 100 != tool || whole % 100 != offset)
        return false;
    }
  return own.size() >= manyTools && !own.count(tool);
}

} // namespace

bool OffsetHabits::isTool(int64_t number, const RuleContext &ctx) const {
  return lengthsOf(ctx).tools.count(number) != 0;
}

bool OffsetHabits::isSlip(const Word &length, const RuleContext &ctx) const {
  if (!isLength(length) || !length.isNumber())
    return false;
  const Lengths &known = lengthsOf(ctx);
  return known.other.size() == 1 && known.own.size() >= manyTools &&
         !known.own.count(*known.other.begin()) && !isFurtherLength(length, *known.other.begin());
}

bool OffsetHabits::breaksHabit(const Word &length, const RuleContext &ctx) const {
  if (!isLength(length))
    return false;
  const Lengths &known = lengthsOf(ctx);
  return known.other.size() == 1 &&
         (known.own.size() >= manyTools ||
          (known.own.size() >= fewTools && !isFurtherLength(length, *known.other.begin())));
}

bool OffsetHabits::isOnlyStation(int64_t tool, int64_t offset, const RuleContext &ctx) const {
  return stations_.of({ctx.source().id(), tool * 100 + offset},
                      [&] { return isOnlyOne(tool, offset, ctx); });
}

bool OffsetHabits::subtractsOnce(const RuleContext &ctx) const {
  const uint32_t program = ctx.index().programAt(ctx.block().begin).begin;
  return subtractions_.of({ctx.source().id(), program},
                          [&] { return subtractsOne(ctx, ctx.index().programAt(program)); });
}

const OffsetHabits::Lengths &OffsetHabits::lengthsOf(const RuleContext &ctx) const {
  return lengths_.of(ctx.source().id(), [&] {
    Lengths known;
    for (const ProgramInfo &program : ctx.index().programs()) {
      int64_t inUse = 0;
      constexpr AddressMask wanted = maskOf(letterAddress('T')) | maskOf(letterAddress('H'));
      for (const Block &block : blocksWith(ctx.index(), program, wanted)) {
        if (const Word *tool = block.find(letterAddress('T')); tool && tool->isNumber()) {
          inUse = int64_t(tool->value());
          known.tools.insert(inUse);
        }
        const Word *length = block.find(letterAddress('H'));
        if (inUse > 0 && length && length->isNumber() && length->value() != 0)
          (int64_t(length->value()) == inUse ? known.own : known.other).insert(inUse);
      }
    }
    return known;
  });
}

} // namespace ncvet
