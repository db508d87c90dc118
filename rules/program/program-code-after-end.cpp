// Blocks after the program's end that nothing reaches.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/gathering_rule.h"

#include <map>

namespace ncvet {
namespace {

struct ProgramEndPlace {
  TextPlace block, next; ///< and the one after it
  TextPlace codeBegin, codeEnd;
};

struct ProgramCodeAfterEndMemory {
  Aside<bool> ended; ///< some program has
};

/// Of each block that ends a program one, however often it is executed.
using ProgramEnds = std::map<TextPlace, ProgramEndPlace>;

class ProgramCodeAfterEnd final
    : public GatheringRule<ProgramCodeAfterEndMemory, ProgramEndPlace, ProgramEnds> {
public:
  void listen(Subscriptions &to) override {
    to.gathers();
    to.on({EventKind::ProgramEnd, EventKind::Return});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (!event.word)
      return;
    const auto place = [&](uint32_t offset) { return TextPlace{ctx.source().id(), offset}; };
    const SourceRange code = ctx.range(*event.word);
    const ProgramEndPlace end{place(ctx.block().begin), place(ctx.block().next), place(code.begin),
                              place(code.end)};
    note(end);
    takeOver(end);
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (!file.complete || file.anyNumberUsed || !memory().ended.look())
      return;
    for (const auto &[at, end] : list())
      if (at.file == file.source.id())
        tellAfter(end, file, ctx);
  }

protected:
  bool takeOver(llvm::ArrayRef<ProgramEndPlace> ends) const override {
    memory().ended.note() = true;
    for (const ProgramEndPlace &end : ends)
      list().try_emplace(end.block, end);
    return true;
  }

private:
  /// The end of an IF or of a loop in which the end code is: it does nothing by itself.
  static bool isOnlyBracket(const Block &block) {
    return block.words.empty() && !block.items.empty() &&
           llvm::all_of(block.items, [](const Item &item) {
             if (item.kind == ItemKind::End)
               return true;
             if (item.kind != ItemKind::Structure)
               return false;
             switch (item.structure) {
             case Structure::Else:
             case Structure::EndIf:
             case Structure::EndWhile:
             case Structure::EndFor:
             case Structure::EndLoop:
             case Structure::EndTimes:
             case Structure::Sub:
             case Structure::EndSub:
               return true;
             default:
               return false;
             }
           });
  }

  /// `M30` after `M99`: the switch between one part and many.
  static bool isFurtherEnd(const Block &block, const RuleContext &ctx) {
    return block.items.empty() &&
           findCode(ctx.dialect(), block, {Action::ProgramEnd, Action::ProgramEndRewind});
  }

  void tellAfter(const ProgramEndPlace &end, const FileSummary &file, RuleContext &ctx) const {
    const uint32_t stop = file.index.programAt(end.block.offset).end;
    SourceRange dead;
    uint64_t count = 0;
    const auto read = [&](uint32_t at, const Block &block) {
      if (block.kind == BlockKind::Tape || block.kind == BlockKind::ProgramHeader)
        return false;
      if (block.isEmpty() || isOnlyBracket(block) || isFurtherEnd(block, ctx))
        return true;
      // A guard of arguments that every call gives is named by a jump, taken or not.
      if (file.isReached(at) ||
          (block.number >= 0 && llvm::is_contained(file.usedNumbers, block.number)))
        return false;
      if (count++ == 0)
        dead = {file.source.id(), block.begin, block.end};
      return true;
    };
    const auto pass = [&](const TextPiece &piece) {
      if (count == 0 || file.isAnyReached(piece.begin, piece.end))
        return false;
      count += piece.blocks;
      return true;
    };
    file.index.eachBlock(end.next.offset, stop, read, pass);
    if (!count)
      return;
    const SourceRange code{end.block.file, end.codeBegin.offset, end.codeEnd.offset};
    if (auto finding = ctx.report(dead))
      finding
          .message(
              count == 1
                  ? "this block after `{0}` is never executed: no call, jump or profile reaches it"
                  : "these {1} blocks after `{0}` are never executed: no call, jump or profile "
                    "reaches them",
              ctx.text(code), count)
          .note(code, "the program ends here");
  }
};

} // namespace
NCVET_RULE(ProgramCodeAfterEnd, program_code_after_end)
} // namespace ncvet
