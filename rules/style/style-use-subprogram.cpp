// A profile that a cycle reads stands in the middle of the main program.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class StyleUseSubprogram final : public Rule {
public:
  void listen(Subscriptions &to) override {
    for (const CodeInfo &code : to.dialect().codes)
      records_ |= code.action == Action::ProfileBegin;
    if (records_)
      to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) override {
    const Origin &begin = ctx.before().origin.rough;
    if (ctx.before().profile != 1 || ctx.callDepth() > 0 || !event.axes || !begin.known() ||
        begin.begin == said_)
      return;
    said_ = begin.begin;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("this profile is recorded in the middle of the main program: in a program of "
                   "its own it can be used again")
          .note(begin, "it is recorded from here on");
  }

private:
  bool records_ = false; ///< the control records profiles
  uint32_t said_ = ~0u;  ///< the recording that was reported last
};

} // namespace
NCVET_RULE(StyleUseSubprogram, style_use_subprogram)
} // namespace ncvet
