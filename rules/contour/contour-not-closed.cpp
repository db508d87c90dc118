// The contour of a pocket or island that does not end where it begins.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ContourNotClosed final : public Rule {
public:
  void listen(Subscriptions &to) override {
    bool wanted = false;
    for (const CodeInfo &code : to.dialect().codes)
      wanted |= isClosed(code);
    if (!wanted)
      return;
    to.onAction({Action::ProfileBegin, Action::ProfileRun, Action::CompensationOff});
    to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Motion) {
      if (closed_ && ctx.before().profile == 1 && ctx.before().compensation == phaseOff &&
          ctx.after().compensation != phaseOff) {
        start_ = ctx.after().position;
        begin_ = ctx.blockRange();
      }
      return;
    }
    if (ctx.code(event).action != Action::CompensationOff) {
      closed_ = isClosed(ctx.code(event));
      begin_ = {};
      return;
    }
    if (!closed_ || !begin_.end || ctx.before().profile != 1)
      return;
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    bool apart = false;
    for (unsigned axis = 0; axis < axisCount; ++axis) {
      const Interval &first = start_[axis], &last = ctx.before().position[axis];
      if (!(plane >> axis & 1))
        continue;
      if (!first.isConstant() || !last.isConstant())
        return;
      apart |= first.value() != last.value();
    }
    const SourceRange begin = begin_;
    begin_ = {};
    if (!apart)
      return;
    if (auto finding = ctx.report(begin))
      finding.message("this contour does not end where it begins: it encloses nothing")
          .note(ctx.blockRange(), "it ends in front of this block");
  }

private:
  /// A profile that encloses something has a point from which the tool comes.
  static bool isClosed(const CodeInfo &code) {
    return code.action == Action::ProfileBegin &&
           llvm::any_of(code.words, [](const WordSpec &w) { return w.role == Role::Target; });
  }

  bool closed_ = false; ///< such a profile is being recorded
  SourceRange begin_;   ///< the block that attaches; empty: none yet
  std::array<Interval, axisCount> start_;
};

} // namespace
NCVET_RULE(ContourNotClosed, contour_not_closed)
} // namespace ncvet
