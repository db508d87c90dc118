// The block that was executed before the current one, as far as the text tells the way.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// Goes back from the current block, block by block: to a caller from the first block of a called
/// program, and into a called program from the block after its call. Jumps are not seen. Only
/// blocks that do something themselves are given: those that call, return or hold nothing are
/// passed over.
class BlocksBefore {
public:
  explicit BlocksBefore(const RuleContext &ctx);

  /// The block before; false where the text does not tell it.
  bool next(Block &block);
  /// The file of the block that was read last.
  FileUnit &unit() const { return *unit_; }

private:
  bool backInProgram(Block &block);
  /// Into the last block of the program that `block` calls; false: it calls none, or the text does
  /// not tell which one.
  bool enter(const Block &block, bool &calls);

  const Dialect &dialect_;
  FileUnit *unit_;
  const ProgramInfo *program_;
  uint32_t at_; ///< begin of the block from which to go back
  const CallSite *caller_;
  /// A program that was called on the way, where it is gone back to.
  struct Place {
    FileUnit *unit;
    const ProgramInfo *program;
    uint32_t at;
  };
  llvm::SmallVector<Place, 2> entered_;
  unsigned left_;
};

} // namespace ncvet
