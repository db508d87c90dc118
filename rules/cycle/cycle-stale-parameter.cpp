// A cycle takes a value that was meant for another one.
#include "analyzer/rule.h"

#include <map>

namespace ncvet {
namespace {

class CycleStaleParameter final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    to.onCode([](const CodeInfo &code) {
      return llvm::any_of(code.words, [](const WordSpec &w) { return w.variable; }) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) override {
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    for (const WordSpec &spec : code.words) {
      if (!spec.variable)
        continue;
      const auto last = meant_.find(spec.variable);
      if (wordFor(ctx.block(), spec)) {
        meant_[spec.variable] = code.base;
        continue;
      }
      if (last == meant_.end() || last->second == code.base ||
          !ctx.before().commons.has(spec.variable) || shared(spec))
        continue;
      const CodeInfo &other = ctx.dialect().codes[last->second];
      if (auto finding = ctx.report(event))
        finding.severity(Severity::Warning)
            .message("`{0}` has no {1} in its block and takes the one that was given for `{2}`",
                     code.name, spec.name, other.name);
      meant_[spec.variable] = code.base;
    }
  }

private:
  static constexpr llvm::StringLiteral id{"cycle-stale-parameter"};
  /// Depth, heights and feed mean the same to every cycle.
  static bool shared(const WordSpec &spec) {
    return spec.role == Role::Depth || spec.role == Role::Retract || spec.role == Role::Height ||
           spec.role == Role::Feed;
  }

  std::map<uint64_t, CodeIndex> meant_; ///< by variable: the code in whose block it was given last
};

} // namespace
NCVET_RULE(CycleStaleParameter, cycle_stale_parameter)
} // namespace ncvet
