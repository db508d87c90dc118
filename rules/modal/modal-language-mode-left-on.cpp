// The control is left in another language.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ModalLanguageModeLeftOn final : public Rule {
public:
  void listen(Subscriptions &to) override {
    for (size_t i = 0; i < to.dialect().groups.size(); ++i)
      if (to.dialect().groups[i].id == "language") {
        group_ = GroupIndex(i);
        to.on(EventKind::ProgramEnd);
        to.onCode([&](const CodeInfo &code) { return !code.letter && code.group != group_; });
      }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const GroupInfo &group = ctx.dialect().groups[group_];
    const uint64_t own = group.initial == 0xFF ? 0 : uint64_t(1) << group.initial;
    const uint64_t now = ctx.after().group(group_);
    if (event.kind == EventKind::Code)
      return ownWord(event, own, ctx);
    if (now == groupUnset || (now & own))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("the program ends in the language of another control: the next program is read "
                   "in it")
          .note(ctx.after().origin.ofGroup(group_), "it is switched on here");
  }

private:
  /// A word of the control's own language while the other one is certainly read.
  void ownWord(const Event &event, uint64_t own, RuleContext &ctx) const {
    const uint64_t before = ctx.before().group(group_);
    if (before == groupUnset || (before & own) || !before || ctx.find({Action::ProgramEnd}))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` is a word of the control's own language, and another one is switched on",
                   ctx.text(*event.word))
          .note(ctx.before().origin.ofGroup(group_), "it is switched on here");
  }

  GroupIndex group_ = noGroup;
};

} // namespace
NCVET_RULE(ModalLanguageModeLeftOn, modal_language_mode_left_on)
} // namespace ncvet
