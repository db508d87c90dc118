// A label that two blocks of a program carry.
#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class FlowDuplicateLabel final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.flowIssue() != FlowIssue::DuplicateLabel)
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding
          .message("the label of `{0}` is taken: an earlier bracket has it",
                   ctx.text(ctx.flowRange()))
          .note(ctx.flowRelated(), "it begins here");
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    constexpr size_t readable = 4u << 20; // a program that long was made by a machine
    if (!ctx.dialect().lexical.commaSeparates || file.source.text().size() > readable)
      return; // no labels there
    Block block;
    for (const ProgramInfo &program : file.index.programs())
      for (const auto &label : file.index.labels(program)) {
        const std::vector<uint32_t> &places = label.getValue();
        if (places.size() < 2 || label.getKey() == ctx.dialect().lexical.endLabel)
          continue;
        file.reader.read(places[0], block);
        const SourceRange first{file.source.id(), block.labelBegin, block.labelEnd};
        file.reader.read(places[1], block);
        const SourceRange range{file.source.id(), block.labelBegin, block.labelEnd};
        if (auto finding = ctx.report(range)) {
          finding
              .message("the label `{0}` is at two blocks: a jump finds only one of them",
                       ctx.text(range))
              .note(first, "it is here too");
          if (!choosesBetween(program, label.getKey(), places, file))
            finding.severity(Severity::Style);
        }
      }
  }

private:
  /// Whether a jump has two of the label's blocks on the side to which it looks: it takes the
  /// nearer one, and the other may have been meant.
  static bool choosesBetween(const ProgramInfo &program, llvm::StringRef label,
                             llvm::ArrayRef<uint32_t> places, const FileSummary &file) {
    for (const Block &block : blocks(file.reader, program.body, program.end))
      for (const Item &item : block.items) {
        if (item.kind != ItemKind::Jump)
          continue;
        for (const Argument &target : block.argumentsOf(item)) {
          if (target.kind != ArgumentKind::Label ||
              file.reader.labelKey(file.source.text(target.begin, target.end)) != label)
            continue;
          const Search search = searchOf(searchKind(item, target));
          const auto after =
              llvm::count_if(places, [&](uint32_t place) { return place > block.begin; });
          const auto before = ptrdiff_t(places.size()) - after;
          if ((search != Search::Backward && after > 1) ||
              (search == Search::Backward && before > 1))
            return true;
        }
      }
    return false;
  }
};

} // namespace
NCVET_RULE(FlowDuplicateLabel, flow_duplicate_label)
} // namespace ncvet
