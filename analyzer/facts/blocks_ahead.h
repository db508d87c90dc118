// The blocks that come after the current one, in the order in which the control executes them.
#pragma once

#include "analyzer/program/call_site.h"
#include "analyzer/program/references.h"
#include "analyzer/rule/rule.h"

namespace ncvet {

/// Reads on from the current block: into the programs that are called, back to their callers, along
/// jumps without a condition. Ends where only the run itself decides what comes next. Outlives the
/// call in which it was made, not the run of the program that the block is in.
class BlocksAhead {
public:
  explicit BlocksAhead(const RuleContext &ctx);
  /// The same after the block `from` of `unit`, as if it led nowhere else; the callers of its
  /// program are not known.
  BlocksAhead(FileUnit &unit, const Block &from);
  /// The same after a call that has come back.
  static BlocksAhead afterCall(const RuleContext &ctx) {
    BlocksAhead ahead(ctx.unit(), ctx.block());
    ahead.caller_ = ctx.caller();
    return ahead;
  }

  /// The next block that holds anything to execute. Where there is none, `block` is left as it is.
  bool next(Block &block);
  /// The same past blocks that only call or return.
  bool nextAtWork(Block &block);
  /// After `next` was false: whether the program ends there. Otherwise something follows that the
  /// texts do not tell.
  bool isOver() const { return way_ == Way::Over; }
  /// The file of the block that was read last.
  FileUnit &unit() const { return *readIn_; }
  /// Where the words of that block are.
  SourceRange range(const Block &block) const;

private:
  enum class Way : uint8_t { GoesOn, Over, Untold };

  Way follow(const Block &block);
  Way endOf(const CodeInfo &ending, const Block &block);
  Way comeBack(const Block &block);
  Way goTo(FileUnit &unit, const ProgramInfo &program, std::optional<uint32_t> at);
  Way enter(const Block &block);

  /// A call that was followed on the way.
  struct Entered {
    FileUnit *unit;
    const ProgramInfo *program;
    uint32_t next;
    bool once;
  };
  FileUnit *unit_;             ///< of the next block
  const ProgramInfo *program_; ///< the same
  FileUnit *readIn_;
  const FileIndex &own_; ///< of the current block's file: it notes what is looked at
  uint32_t at_ = 0;      ///< of the next block
  const CallSite *caller_;
  llvm::SmallVector<Entered, 2> entered_;
  unsigned left_;
  Way way_;
};

/// Whether one of the next blocks, `furthest` at most, `gives` something before one `needs` it.
/// False when the current block moves an axis itself.
bool comesInTime(const RuleContext &ctx, unsigned furthest,
                 llvm::function_ref<bool(const Block &)> gives,
                 llvm::function_ref<bool(const Block &)> needs);
/// Whether the block has words of axes.
bool namesAxes(const Dialect &dialect, const Block &block);

} // namespace ncvet
