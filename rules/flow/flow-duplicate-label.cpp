// A label that two blocks of a program carry.
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
        const std::vector<uint32_t> &blocks = label.getValue();
        if (blocks.size() < 2 || label.getKey() == ctx.dialect().lexical.endLabel)
          continue;
        file.reader.read(blocks[0], block);
        const SourceRange first{file.source.id(), block.labelBegin, block.labelEnd};
        file.reader.read(blocks[1], block);
        const SourceRange range{file.source.id(), block.labelBegin, block.labelEnd};
        if (auto finding = ctx.report(range))
          finding
              .message("the label `{0}` is at two blocks: a jump finds only one of them",
                       ctx.text(range))
              .note(first, "it is here too");
      }
  }
};

} // namespace
NCVET_RULE(FlowDuplicateLabel, flow_duplicate_label)
} // namespace ncvet
