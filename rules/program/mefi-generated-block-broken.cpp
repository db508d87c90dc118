// A generated block that its dialog can no longer edit, or whose next edit loses something.
#include "analyzer/facts/drill_parts.h"
#include "analyzer/facts/generated_block.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {
namespace {

class MefiGeneratedBlockBroken final : public Rule {
public:
  void listen(Subscriptions &to) override { wanted_ = hasDialogs(to.dialect()); }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (!wanted_)
      return;
    const Dialogs dialogs = dialogsOf(ctx.dialect(), ctx.machine());
    const llvm::StringRef text = file.source.text();
    const FileId id = file.source.id();
    for (const Block &block : blocks(file.reader)) {
      const GeneratedBlock generated = readGenerated(block, text);
      if (!generated.isGenerated())
        continue;
      checkPage(generated, block, dialogs, text, id, ctx);
      if (!checkCode(generated, block, text, id, ctx))
        for (const Comment *own : generated.own)
          if (auto finding = ctx.report(SourceRange{id, own->begin, own->end}))
            finding.message("a comment inside a generated block: the next edit in its dialog "
                            "deletes it; comments go before the block's `N`");
    }
  }

private:
  static void checkPage(const GeneratedBlock &generated, const Block &block, const Dialogs &dialogs,
                        llvm::StringRef text, FileId id, RuleContext &ctx) {
    if (!generated.page) {
      if (generated.notice)
        if (auto finding =
                ctx.report(SourceRange{id, generated.notice->begin, generated.notice->end}))
          finding.message("the line `HtmlFile = '...'` of this generated block is missing: no "
                          "dialog can edit it any more");
      return;
    }
    const SourceRange range{id, generated.page->begin, generated.page->end};
    const Dialog *dialog = dialogs.find(generated.path);
    if (!dialog)
      return misspelt(generated.path, range, dialogs, ctx); // or one that nobody told of
    const std::string due = dialogs.folder + dialog->file;
    if (!dialogs.folder.empty() && generated.path != due) {
      const auto begin = uint32_t(generated.path.data() - text.data());
      if (auto finding = ctx.report(range))
        finding
            .message("the dialog's path is not letter by letter `{0}`: the block can no longer be "
                     "edited graphically",
                     due)
            .fix(FixSafety::Unsafe, "write the path of the installed dialog",
                 ctx.replace({id, begin, begin + uint32_t(generated.path.size())}, due));
      return;
    }
    const Item *part = findAssignment(block, "CYC_COPY_PART", text);
    if (!part)
      return;
    const std::string name = text.slice(part->nameEnd, part->end).ltrim(" \t=").upper();
    const bool known =
        llvm::any_of(dialogs.list, [&](const Dialog &other) { return other.part == name; }) ||
        drillParts(ctx.dialect(), ctx.machine()).count(name);
    if (!name.empty() && name != dialog->part && (known || dialog->part.empty()))
      if (auto finding = ctx.report(range))
        finding.message("`{0}` is not the dialog of part `{1}`: it cannot edit this block",
                        dialog->file, name);
  }

  static std::string lettersOf(llvm::StringRef name) {
    std::string letters;
    for (const char c : name)
      if (!llvm::isDigit(c))
        letters += llvm::toLower(c);
    return letters;
  }

  /// The name of a known dialog with a letter or two changed.
  static void misspelt(llvm::StringRef path, SourceRange range, const Dialogs &dialogs,
                       RuleContext &ctx) {
    constexpr unsigned most = 2; // letters
    const size_t folder = path.find_last_of("\\/");
    const std::string file =
        lettersOf(path.substr(folder == llvm::StringRef::npos ? 0 : folder + 1));
    for (const Dialog &known : dialogs.list) {
      const std::string letters = lettersOf(known.file);
      // Another number is another dialog.
      if (letters == file || letters.size() <= 4 * most ||
          llvm::StringRef(file).edit_distance(letters, true, most) > most)
        continue;
      if (auto finding = ctx.report(range))
        finding.message("there is no dialog of this name that is known, but `{0}`: the block can "
                        "no longer be edited graphically",
                        known.file);
      return;
    }
  }

  /// The text of a Technology block; true when it was reported.
  static bool checkCode(const GeneratedBlock &generated, const Block &block, llvm::StringRef text,
                        FileId id, RuleContext &ctx) {
    if (!generated.isTechnology())
      return false;
    const Comment &line = *generated.codeLines.front();
    const SourceRange range{id, line.begin, line.end};
    const llvm::StringRef code = generated.code;
    if (code.contains('"')) {
      if (auto finding = ctx.report(range))
        finding.message("a comment in the text of a Technology block: the dialog takes none");
      return true;
    }
    if (code.size() > 1 && (code[0] == 'N' || code[0] == 'n') && llvm::isDigit(code[1])) {
      if (auto finding = ctx.report(range))
        finding.message("a block number in the text of a Technology block: the code below it "
                        "becomes a block of its own");
      return true;
    }
    const std::string below = codeAfter(generated, block, text);
    if (code.equals_insensitive(below))
      return false;
    if (auto finding = ctx.report(range))
      finding.message("the dialog holds `{0}`, the code below says `{1}`: the next edit brings the "
                      "dialog's text back",
                      code, below);
    return true;
  }

  bool wanted_ = false;
};

} // namespace
NCVET_RULE(MefiGeneratedBlockBroken, mefi_generated_block_broken)
} // namespace ncvet
