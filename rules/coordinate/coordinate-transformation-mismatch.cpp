// A transformation that does not fit the machine.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CoordinateTransformationMismatch final : public Rule {
public:
  /// The tables say when: in the block of a code, and where a modal cycle of theirs runs.
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    const bool cycles = llvm::any_of(to.dialect().codes, [](const CodeInfo &code) {
      return code.action == Action::Cycle &&
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
    if (cycles)
      to.on(EventKind::CycleRun);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode)
      return;
    const bool here =
        llvm::any_of(ctx.codes(), [&](const CodeUse &use) { return use.code == event.code; });
    if (event.kind == EventKind::Code || !here)
      ctx.reportNotices(id, event);
  }

private:
  static constexpr llvm::StringLiteral id{"coordinate-transformation-mismatch"};
};

} // namespace
NCVET_RULE(CoordinateTransformationMismatch, coordinate_transformation_mismatch)
} // namespace ncvet
