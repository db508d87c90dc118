// A feed is programmed before the program has said what it is measured in.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ProgramSafeStartMissing final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().group(StandardGroup::FeedMode) != noGroup)
      to.on(EventKind::FeedWord);
  }

  void on(const Event &event, RuleContext &ctx) override {
    const GroupIndex group = ctx.dialect().group(StandardGroup::FeedMode);
    const uint64_t bit = uint64_t(1) << group;
    // A thread's F is a lead whatever the mode; the first F says it once for the program.
    if (ctx.after().must(Fact::FeedIsLead) || ctx.before().must(Fact::FeedSet) ||
        ctx.after().statedMust & bit || ctx.before().may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(event, event.certain && !(ctx.after().statedMay & bit)))
      finding.message(
          "`{0}` stands before the program has stated {1}: its unit is what the machine "
          "was left in",
          ctx.text(*event.word), modes(ctx.dialect(), group));
  }

private:
  static std::string modes(const Dialect &dialect, GroupIndex group) {
    std::string text;
    const auto &members = dialect.groups[group].members;
    for (size_t i = 0; i < members.size(); ++i) {
      if (i)
        text += i + 1 == members.size() ? " or " : ", ";
      text += "`" + dialect.codes[members[i]].name + "`";
    }
    return text;
  }
};

} // namespace
NCVET_RULE(ProgramSafeStartMissing, program_safe_start_missing)
} // namespace ncvet
