// Rules that remember something beside their memory: the compiler's error of each names the class
// that is marked with words of the message. What is not marked compiles.
#include "analyzer/rule/gathering_rule.h"

namespace ncvet {
namespace {

struct CountingMemory {
  unsigned blocks = 0;
};

class Counting final : public StatefulRule<CountingMemory> {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Block); }

  void on(const Event &, RuleContext &ctx) const override {
    if (++memory().blocks == 2)
      ctx.report(ctx.blockRange());
  }
};

class Forgetting final // error: read-only|const-qualified|const member function
    : public StatefulRule<CountingMemory> {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Block); }

  void on(const Event &, RuleContext &) const override { reported_ = true; }

private:
  bool reported_ = false;
};

class Changing final // error: marked .override.|does not override
    : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Block); }
  void on(const Event &, RuleContext &) override {}
};

class GathersByHand final // error: overriding final|overrides a .final. function
    : public GatheringRule<CountingMemory, TextPlace> {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Block); }
  bool gather(const Gathered &) override { return true; }

private:
  bool takeOver(llvm::ArrayRef<TextPlace>) const override { return true; }
};

class ByHand final // error: overriding final|overrides a .final. function
    : public StatefulRule<CountingMemory> {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Block); }
  void remember(RuleMemory &) const override {}
};

struct Pointer { // error: can only remember what can be compared
  const Block *last = nullptr;
};

class FirstOfTwo {
public:
  const auto &remembered() const { return first_; }

private:
  unsigned first_ = 0, second_ = 0;
};

struct InPart { // error: a member is not remembered
  FirstOfTwo values;
};

class TellsByItself {
public:
  void remember(RuleMemory &memory) const { memory(first_); }

private:
  unsigned first_ = 0, second_ = 0;
};

struct ValuesByHand { // error: can only remember what can be compared
  TellsByItself values;
};

template <class Memory>
class Remembering final : public StatefulRule<Memory> {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Block); }
  void on(const Event &, RuleContext &) const override {}
};

const Remembering<CountingMemory> right;
const Remembering<Pointer> pointer;
const Remembering<InPart> inPart;
const Remembering<ValuesByHand> byHand;

} // namespace
NCVET_RULE(Counting, counting)
} // namespace ncvet
