// Rules that must not compile, one for each word that is defined, and one that must.
#include "analyzer/rule/gathering_rule.h"

namespace ncvet {
namespace {

#ifdef REMEMBERS_A_VALUE_IN_PART
class Values {
public:
  const auto &remembered() const { return first_; }

private:
  unsigned first_ = 0, second_ = 0;
};
#endif

#ifdef REMEMBERS_A_VALUE_BY_HAND
class Values {
public:
  void remember(RuleMemory &memory) const { memory(first_); }

private:
  unsigned first_ = 0, second_ = 0;
};
#endif

struct CountingMemory {
  unsigned blocks = 0;
#if defined(REMEMBERS_A_VALUE_IN_PART) || defined(REMEMBERS_A_VALUE_BY_HAND)
  Values values;
#endif
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

#ifdef GATHERS_BY_HAND
class GathersByHand final : public GatheringRule<CountingMemory, TextPlace> {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Block); }
  bool gather(const Gathered &) override { return true; }

private:
  bool takeOver(llvm::ArrayRef<TextPlace>) const override { return true; }
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
