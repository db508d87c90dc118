// A rule that crashes at comments that ask for it. Linked into a copy of ncvet, of which tests see
// what becomes of the other files.
#include "analyzer/rule/rule.h"

#include <cstdlib>
#include <stdexcept>

namespace ncvet {

/// The linker gives the real table this name and calls of it to the one below.
llvm::ArrayRef<RuleEntry> realRules() __asm__("__real__ZN5ncvet8allRulesEv");
llvm::ArrayRef<RuleEntry> rulesWithCrash() __asm__("__wrap__ZN5ncvet8allRulesEv");

namespace {

// Deeper than any stack; the volatile keeps each call real.
int recurse(const volatile int *outer) {
  volatile int here[64] = {*outer};
  return recurse(here) + here[1];
}

class CrashingRule final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Block); }

  void on(const Event &, RuleContext &ctx) const override {
    const llvm::StringRef text = ctx.source().text(ctx.block().begin, ctx.block().end);
    if (text.contains("(CRASH)")) {
      int *volatile nowhere = nullptr;
      *nowhere = 1;
    }
    if (text.contains("(ABORT)"))
      std::abort();
    if (text.contains("(OVERFLOW)")) {
      const volatile int start = 1;
      if (recurse(&start) == 0)
        std::abort();
    }
    if (text.contains("(THROW)"))
      throw std::runtime_error("thrown by a rule");
  }
};

} // namespace

llvm::ArrayRef<RuleEntry> rulesWithCrash() {
  static const std::vector<RuleEntry> all = [] {
    std::vector<RuleEntry> rules = realRules().vec();
    RuleEntry crashing = rules.back();
    crashing.info.id = "test-crash";
    crashing.info.category = "test";
    crashing.info.enabledByDefault = true;
    crashing.make = [] { return std::unique_ptr<Rule>(std::make_unique<CrashingRule>()); };
    rules.push_back(std::move(crashing));
    return rules;
  }();
  return all;
}

} // namespace ncvet
