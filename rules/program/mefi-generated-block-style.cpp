// A generated block that departs from what its dialog writes, without harm.
#include "analyzer/facts/generated_block.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

/// `FEED` and `CYC_FEED` are two names of one parameter.
constexpr llvm::StringLiteral longFamily = "CYC_";
constexpr llvm::StringLiteral twoNames[] = {"FEED", "SPINDLESPEED"};

struct MefiGeneratedBlockStyleMemory {
  bool seenLong = false;
  bool seenShort = false;
};

class MefiGeneratedBlockStyle final : public StatefulRule<MefiGeneratedBlockStyleMemory> {
public:
  void listen(Subscriptions &to) override { wanted_ = hasDialogs(to.dialect()); }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (!wanted_)
      return;
    const Dialogs dialogs = dialogsOf(ctx.dialect(), ctx.machine());
    const llvm::StringRef text = file.source.text();
    const FileId id = file.source.id();
    bool technologyBefore = false;
    for (const Block &block : blocks(file.reader)) {
      if (block.kind == BlockKind::Empty)
        continue;
      const GeneratedBlock generated = readGenerated(block, text);
      checkNames(block, text, id, ctx);
      checkComments(generated, technologyBefore, id, ctx);
      checkLines(generated, block, dialogs, text, id, ctx);
      technologyBefore = generated.isTechnology();
    }
  }

private:
  /// One family of names for feed and speed in a file.
  void checkNames(const Block &block, llvm::StringRef text, FileId id, RuleContext &ctx) const {
    for (const Item &item : block.items) {
      const std::string name = assignedName(item, text);
      llvm::StringRef bare = name;
      const bool isLong = bare.consume_front(longFamily);
      if (!llvm::is_contained(twoNames, bare))
        continue;
      bool &seen = isLong ? memory().seenLong : memory().seenShort;
      const bool departs = !seen && (isLong ? memory().seenShort : memory().seenLong);
      seen = true;
      if (!departs)
        continue;
      if (auto finding = ctx.report(SourceRange{id, item.nameBegin, item.nameEnd}))
        finding.message("`{0}` here, the other family of names (`{1}`) before: one file uses one",
                        name, isLong ? bare.str() : (longFamily + bare).str());
    }
  }

  static void checkComments(const GeneratedBlock &generated, bool technologyBefore, FileId id,
                            RuleContext &ctx) {
    const Comment *line = generated.page             ? generated.page
                          : generated.isTechnology() ? generated.codeLines.front()
                                                     : nullptr;
    if (line && !generated.notice)
      if (auto finding = ctx.report(SourceRange{id, line->begin, line->end}))
        finding.message("the first line of this generated block, which warns of changing it by "
                        "hand, was taken away");
    if (!technologyBefore || !generated.isTechnology())
      return;
    const Comment &second = *generated.codeLines.front();
    if (auto finding = ctx.report(SourceRange{id, second.begin, second.end}))
      finding.message("a second Technology block in a row: write the blocks directly");
  }

  /// All lines that the dialog writes are there.
  static void checkLines(const GeneratedBlock &generated, const Block &block,
                         const Dialogs &dialogs, llvm::StringRef text, FileId id,
                         RuleContext &ctx) {
    const Dialog *dialog = generated.page ? dialogs.find(generated.path) : nullptr;
    const Word *call = block.find(keywordAddress);
    if (!dialog || dialog->part.empty() || !call)
      return;
    for (const WordSpec &spec : ctx.dialect().codes[size_t(call->mantissa)].words) {
      if (!spec.variable || spec.role != Role::Argument)
        continue;
      llvm::StringRef bare = spec.name;
      bare.consume_front(longFamily);
      if (findAssignment(block, spec.name, text) || findAssignment(block, bare, text) ||
          findAssignment(block, (longFamily + bare).str(), text))
        continue;
      const Comment &head = generated.notice ? *generated.notice : *generated.page;
      if (auto finding = ctx.report(SourceRange{id, head.begin, head.end}))
        finding.message("the line `{0}`, which the dialog writes, is missing: generated blocks "
                        "are changed in their dialog",
                        spec.name);
      return;
    }
    checkOrder(*dialog, block, dialogs, text, id, ctx);
  }

  /// The lines are as the dialog writes them, and there are no others.
  static void checkOrder(const Dialog &dialog, const Block &block, const Dialogs &dialogs,
                         llvm::StringRef text, FileId id, RuleContext &ctx) {
    // Of the dialogs of other parts nobody knows the lines.
    if (llvm::none_of(dialogs.lines,
                      [&](llvm::StringRef line) { return line.contains("_" + dialog.part + "_"); }))
      return;
    const auto bare = [](llvm::StringRef name) {
      name.consume_front(longFamily);
      return name.str();
    };
    size_t last = 0;
    for (const Word &word : block.words) {
      const SourceRange range{id, word.offset, block.endOf(word)};
      const Item *const item = assignmentAt(block, word);
      if (word.address == keywordAddress || word.address == argumentAddress)
        continue;
      const std::string name = item ? assignedName(*item, text) : std::string();
      const auto at = llvm::find_if(
          dialogs.lines, [&](const std::string &line) { return item && bare(line) == bare(name); });
      const auto place = size_t(at - dialogs.lines.begin());
      if (at != dialogs.lines.end() && place >= last) {
        last = place;
        continue;
      }
      if (auto finding = ctx.report(range))
        finding.message(at == dialogs.lines.end()
                            ? "`{0}` is nothing that the dialog writes: generated blocks are "
                              "changed in their dialog"
                            : "`{0}` is in another place than the dialog gives it: generated "
                              "blocks are changed in their dialog",
                        text.slice(range.begin, range.end));
      return;
    }
  }

  static const Item *assignmentAt(const Block &block, const Word &word) {
    for (const Item &item : block.items)
      if (item.kind == ItemKind::Assignment && item.begin == word.offset)
        return &item;
    return nullptr;
  }

  bool wanted_ = false;
};

} // namespace
NCVET_RULE(MefiGeneratedBlockStyle, mefi_generated_block_style)
} // namespace ncvet
