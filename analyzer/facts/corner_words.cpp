// Which words of a block are chamfers, roundings and line angles.
#include "analyzer/facts/corner_words.h"

#include "interp/path/corner_path.h"

namespace ncvet {

CornerAddresses cornerAddresses(const Dialect &dialect) {
  CornerAddresses result;
  AddressMask takes = 0;
  for (const CodeInfo &code : dialect.codes)
    if (code.action == Action::Linear)
      takes |= code.takes;
  // A lathe's line takes I, K, R and A for itself; on a mill these are other words.
  if (dialect.isLathe()) {
    result.chamfer |= takes & lettersMask("IK");
    result.rounding |= takes & maskOf('R');
    if (dialect.addresses[letterAddress('A')].kind == AddressKind::Parameter)
      result.angle |= takes & maskOf('A');
  }
  result.plain = result.chamfer | result.rounding | result.angle;
  result.chamfer |= takes & maskOf(commaC);
  result.rounding |= takes & maskOf(commaR);
  for (unsigned address = 0; address < addressCount; ++address)
    if (const AddressInfo &info = dialect.addresses[address]; info.corner) {
      (info.rounding ? result.rounding : result.chamfer) |= maskOf(AddressId(address));
      if (info.kind == AddressKind::Axis)
        result.plain |= maskOf(AddressId(address));
    }
  result.angle |= (takes & maskOf(commaA)) | dialect.lineAngleWords;
  return result;
}

bool takenByOther(const RuleContext &ctx, AddressMask letters) {
  for (const CodeUse &use : ctx.codes()) {
    const CodeInfo &code = ctx.code(use);
    if (isMotion(code.action))
      continue;
    AddressMask takes = code.takes;
    for (const WordSpec &spec : code.words)
      takes |= spec.any;
    if (takes & letters)
      return true;
  }
  return false;
}

bool asksForCorner(const RuleContext &ctx, const Word &word) {
  return ctx.dialect().addresses[word.address].kind != AddressKind::Axis ||
         isCornerOfAxis(ctx.dialect(), ctx.block(), ctx.after());
}

bool isLine(const RuleContext &ctx, const Event &motion) {
  (void)ctx;
  return motion.kind == EventKind::Motion && motion.certain && motion.motion == MotionKind::Feed;
}

bool readNeighbour(const RuleContext &ctx, BlocksAhead &ahead, Block &next, unsigned between,
                   bool &passed) {
  passed = false;
  if (!ahead.nextAtWork(next) || !next.items.empty())
    return false;
  for (unsigned i = 0; i < between; ++i) {
    if (axesOf(ctx, next) || !next.hasAny(lettersMask("M")) ||
        next.words.size() != codesOf(ctx.dialect(), next).size() ||
        findCode(ctx.dialect(), next,
                 {Action::Cycle, Action::ProgramEnd, Action::ProgramEndRewind, Action::ProgramStop,
                  Action::ToolChange}))
      break;
    if (!ahead.nextAtWork(next) || !next.items.empty() || next.skip >= 0)
      return false;
    passed = true;
  }
  return true;
}

uint16_t axesOf(const RuleContext &ctx, const Block &block) { return axesOf(ctx.dialect(), block); }

} // namespace ncvet
