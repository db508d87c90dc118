// A local call gives its target as a block number word.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowCallFormat final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::CallLocal});
    to.onNotices("flow-call-format");
  }

  void on(const Event &event, RuleContext &ctx) override {
    ctx.reportNotices("flow-call-format", event);
    if (ctx.code(event).action != Action::CallLocal)
      return;
    const Block &block = ctx.block();
    const Word *number = block.find('N');
    if (block.has(letterAddress('P')) || !number || !number->isNumber())
      return;
    const std::string cure = llvm::formatv("P{0}", number->mantissa).str();
    if (auto finding = ctx.report(*number))
      finding
          .message("`{0}` behind `{1}` reads as a block number: write the target as `{2}`",
                   ctx.text(*number), ctx.text(*event.word), cure)
          .fix(FixSafety::Unsafe, llvm::formatv("write `{0}`", cure).str(),
               ctx.replace(ctx.range(*number), cure));
  }
};

} // namespace
NCVET_RULE(FlowCallFormat, flow_call_format)
} // namespace ncvet
