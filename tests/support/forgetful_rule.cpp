// Rules that must not compile, one for each word that is defined, and one that must.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

struct CountingMemory {
  unsigned blocks = 0;
#ifdef REMEMBERS_WHAT_CANNOT_BE_COMPARED
  const Block *last = nullptr;
#endif
};

class Counting final : public StatefulRule<CountingMemory> {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Block); }

  void on(const Event &, RuleContext &ctx) const override {
#ifdef FORGETS_A_MEMBER
    reported_ = true;
#endif
    if (++memory().blocks == 2)
      ctx.report(ctx.blockRange());
  }

private:
  bool reported_ = false;
};

#ifdef CHANGES_ITSELF
class Changing final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Block); }
  void on(const Event &, RuleContext &) override { ++blocks_; }

private:
  unsigned blocks_ = 0;
};
#endif

#ifdef REMEMBERS_BY_HAND
class ByHand final : public StatefulRule<CountingMemory> {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Block); }
  void remember(RuleMemory &) const override {}
};
#endif

} // namespace
NCVET_RULE(Counting, counting)
} // namespace ncvet
