// The control is left in another language.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ModalLanguageModeLeftOn final : public Rule {
public:
  void listen(Subscriptions &to) override {
    for (size_t i = 0; i < to.dialect().groups.size(); ++i)
      if (to.dialect().groups[i].id == "language") {
        group_ = GroupIndex(i);
        to.on(EventKind::ProgramEnd);
      }
  }

  void on(const Event &event, RuleContext &ctx) override {
    const GroupInfo &group = ctx.dialect().groups[group_];
    const uint64_t own = group.initial == 0xFF ? 0 : uint64_t(1) << group.initial;
    const uint64_t now = ctx.after().group[group_];
    if (now == groupUnset || (now & own))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("the program ends in the language of another control: the next program is read "
                   "in it")
          .note(ctx.after().origin.group[group_], "it is switched on here");
  }

private:
  GroupIndex group_ = noGroup;
};

} // namespace
NCVET_RULE(ModalLanguageModeLeftOn, modal_language_mode_left_on)
} // namespace ncvet
