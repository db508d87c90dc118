// Where the cause of a finding is written: in the file of the current block, or in that of a caller
// or of a called program.
#include "analyzer/facts/cause_place.h"

#include "analyzer/program/project.h"

#include "llvm/Support/Path.h"

namespace ncvet {

std::string lineOf(const RuleContext &ctx, const Origin &origin) {
  const SourceFile &file = ctx.unitOf(origin.file).source;
  std::string line = std::to_string(file.lines().lineOf(origin.begin));
  if (!isHere(ctx, origin))
    line += (" of " + llvm::sys::path::filename(file.display())).str();
  return line;
}

CausePlace causePlace(const RuleContext &ctx, const Origin &cause, SourceRange effect) {
  if (isHere(ctx, cause))
    return {cause.range(), effect, true, "here"};
  return {effect, cause.range(), false, "in line " + lineOf(ctx, cause)};
}

void readBlockOf(const RuleContext &ctx, const Origin &origin, Block &block) {
  const FileUnit &unit = ctx.unitOf(origin.file);
  uint32_t at = std::max(unit.source.lines().lineBegin(origin.begin), unit.source.textBegin());
  do { // several blocks may be on one line
    unit.index.read(at, block);
  } while (block.next <= origin.begin && block.next > std::exchange(at, block.next));
}

} // namespace ncvet
