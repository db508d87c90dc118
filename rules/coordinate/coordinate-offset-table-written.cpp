// A program writes data that later programs work with.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/text_answers.h"

namespace ncvet {
namespace {

class CoordinateOffsetTableWritten final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().machineData.empty())
      to.on(EventKind::Statement);
    to.onNotices(id);
    if (to.dialect().incrementWords)
      to.onAction({Action::FrameAdd});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind != EventKind::Statement) {
      ctx.reportNotices(id, event);
      return again(event, ctx);
    }
    sleepAtBlock();
    const Item &item = ctx.block().items[event.item()];
    if (item.kind != ItemKind::Assignment)
      return;
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    const llvm::StringRef name = ctx.text(range);
    if (!moves_.of(ctx.source().id(), [&] { return moves(ctx); }))
      return; // setting data is what the program is for
    for (const std::string &data : ctx.dialect().machineData)
      if (name.startswith_insensitive(data))
        if (auto finding = ctx.report(range))
          finding.message("`{0}` stays as it is written here: every later program works with it",
                          name);
  }

private:
  /// Blocks that a program runs again: sections that it repeats, and what lies before a jump
  /// that leads back.
  struct Passes {
    uint32_t first, after;
    SourceRange by;
  };

  static std::vector<Passes> passesOf(RuleContext &ctx) {
    std::vector<Passes> passes;
    const FileId file = ctx.source().id();
    for (const RepeatedSection &section : repeatedSections(ctx.index()))
      passes.push_back({section.first, section.after, {file, section.begin, section.end}});
    for (const Block &block :
         blocks(ctx.index(), ctx.index().reader().first(), uint32_t(ctx.source().text().size()))) {
      for (const Item &item : block.items) {
        if (item.kind != ItemKind::Jump || item.nameEnd > item.nameBegin)
          continue;
        for (const Argument &target : block.argumentsOf(item))
          if (const auto to = blockNamed(ctx.index(), block, item, target);
              to && *to <= block.begin)
            passes.push_back({*to, block.next, {file, item.begin, item.end}});
      }
    }
    return passes;
  }

  /// A distance that is added to the offset in every pass.
  void again(const Event &event, RuleContext &ctx) const {
    const CodeInfo &code = ctx.code(event);
    if (code.action != Action::FrameAdd || code.frame != FrameKind::Offset ||
        !ctx.block().hasAny(ctx.dialect().incrementWords))
      return;
    for (const Passes &passes : passes_.of(ctx.source().id(), [&] { return passesOf(ctx); })) {
      if (ctx.block().begin < passes.first || ctx.block().begin >= passes.after)
        continue;
      if (auto finding = ctx.report(event))
        finding
            .message("`{0}` adds a distance: every pass shifts the origin further",
                     ctx.text(*event.word))
            .note(passes.by, "the block is run again from here");
      return;
    }
  }

  /// Whether any block of the text moves an axis, calls a program or runs a cycle.
  static bool moves(RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    for (const Block &block :
         blocks(ctx.index(), ctx.index().reader().first(), uint32_t(ctx.source().text().size())))
      if (block.hasAny(dialect.axisWords | dialect.polarWords) ||
          findCode(dialect, block, {Action::Cycle, Action::ToolChange}) ||
          llvm::any_of(block.items, [](const Item &item) { return item.kind == ItemKind::Call; }))
        return true;
    return false;
  }

  TextAnswers<FileId, std::vector<Passes>> passes_;
  TextAnswers<FileId, bool> moves_;
  static constexpr llvm::StringLiteral id{"coordinate-offset-table-written"};
};

} // namespace
NCVET_RULE(CoordinateOffsetTableWritten, coordinate_offset_table_written)
} // namespace ncvet
