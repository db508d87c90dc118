// The program ends with a code that does not return to its start.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ProgramEndWithoutRewind final : public Rule {
public:
  void listen(Subscriptions &to) override {
    for (const CodeInfo &code : to.dialect().codes)
      if (code.action == Action::ProgramEndRewind)
        rewinds_ = code.name;
    if (!rewinds_.empty())
      to.onAction({Action::ProgramEnd});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (auto finding = ctx.report(event))
      finding
          .message(
              "`{0}` ends the program without going back to its start: the next start begins here",
              ctx.text(*event.word))
          .fix(FixSafety::Unsafe, "use the end code that goes back to the start",
               ctx.replace(ctx.range(*event.word), rewinds_));
  }

private:
  std::string rewinds_;
};

} // namespace
NCVET_RULE(ProgramEndWithoutRewind, program_end_without_rewind)
} // namespace ncvet
