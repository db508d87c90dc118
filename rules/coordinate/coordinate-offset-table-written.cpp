// A program writes data that later programs work with.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/repeated_sections.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/text_answers.h"
#include "formats/dialect/control_facts.h"

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
    if (!to.dialect().facts->variables.workPlaces.empty())
      to.onAction({Action::DataInput});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind != EventKind::Statement) {
      ctx.reportNotices(id, event);
      if (ctx.code(event).action == Action::DataInput)
        return ofWorkPlace(ctx);
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

  /// `G10 L2 P1 X#5001`: a place in the work's coordinates becomes its origin, which counts in the
  /// machine's.
  static void ofWorkPlace(RuleContext &ctx) {
    constexpr double origins = 2, furtherOrigins = 20; // L
    const Word *const kind = ctx.block().find(letterAddress('L'));
    if (!kind || !kind->isNumber() ||
        (kind->value() != origins && kind->value() != furtherOrigins) ||
        ctx.after().isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) ==
            Truth::Yes ||
        writesOtherOrigins(ctx))
      return;
    for (const Word &word : ctx.block().words) {
      if (!(ctx.dialect().axisWords & maskOf(word.address)) || !namesWorkPlace(word, ctx))
        continue;
      if (auto finding = ctx.report(word))
        finding.message("`{0}` is a place in the coordinates of the work, and an origin counts in "
                        "those of the machine",
                        ctx.text(word));
      return;
    }
  }

  static bool namesWorkPlace(const Word &word, const RuleContext &ctx) {
    const Block &block = ctx.block();
    if (!word.has(wordExpression) || size_t(word.mantissa) >= block.expressions.size())
      return false;
    const Expression &expression = block.expressions[size_t(word.mantissa)];
    const ExpressionOp &op = block.operations[expression.first];
    if (expression.count != 1 || op.op != Op::Variable)
      return false;
    const std::vector<int> &places = ctx.dialect().facts->variables.workPlaces;
    for (size_t i = 0; i + 1 < places.size(); i += 2)
      if (op.value >= places[i] && op.value <= places[i + 1])
        return true;
    return false;
  }

  /// An origin that the program sets to the machine's makes the coordinates the same.
  static bool writesOtherOrigins(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block :
         blocksNaming(ctx.index(), program, ctx.dialect(), {Action::DataInput}))
      if (block.begin != ctx.block().begin && findCode(ctx.dialect(), block, {Action::DataInput}) &&
          llvm::none_of(block.words, [](const Word &word) { return word.has(wordExpression); }))
        return true;
    return false;
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
    bool any = false;
    for (const Block &block :
         blocks(ctx.index(), ctx.index().reader().first(), uint32_t(ctx.source().text().size()))) {
      if (findCode(dialect, block, {Action::SkipMove})) // it measures where its work lies
        return false;
      any |=
          block.hasAny(dialect.axisWords | dialect.polarWords) ||
          findCode(dialect, block, {Action::Cycle, Action::ToolChange}) ||
          llvm::any_of(block.items, [](const Item &item) { return item.kind == ItemKind::Call; });
    }
    return any;
  }

  TextAnswers<FileId, std::vector<Passes>> passes_;
  TextAnswers<FileId, bool> moves_;
  static constexpr llvm::StringLiteral id{"coordinate-offset-table-written"};
};

} // namespace
NCVET_RULE(CoordinateOffsetTableWritten, coordinate_offset_table_written)
} // namespace ncvet
