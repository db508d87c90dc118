// A call or jump code has no word that names its target.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class FlowTargetMissing final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::CallProgram, Action::CallLocal, Action::MacroCall, Action::MacroModal,
                 Action::ConditionalJump});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    if (block.has(letterAddress('P')))
      return;
    // A number written as `M97 N500` is the business of flow-call-format.
    const CodeInfo &code = ctx.code(event);
    if (code.elsewhere && code.action == Action::MacroCall) // the code itself names its program
      return;
    if (code.action == Action::CallLocal && block.has(letterAddress('N')))
      return;
    if (block.nameEnd > block.nameBegin)
      return;
    for (const WordSpec &spec : code.words)
      if (spec.role == Role::Sequence && code.action == Action::CallLocal && block.hasAny(spec.any))
        return;
    // A call by name: the text after the code is its target.
    if (block.nameEnd > block.nameBegin)
      return;
    for (const SyntaxIssue &issue : block.issues)
      if (issue.begin >= event.word->offset)
        return;
    if (auto finding = ctx.report(event))
      finding.message(
          "`{0}` without `P` names no {1}: the control stops with an alarm", ctx.text(*event.word),
          code.action == Action::CallLocal || code.action == Action::ConditionalJump ? "block"
                                                                                     : "program");
  }
};

} // namespace
NCVET_RULE(FlowTargetMissing, flow_target_missing)
} // namespace ncvet
