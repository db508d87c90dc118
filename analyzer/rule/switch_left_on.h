// Switches of the machine that a program leaves on: what all the `…-left-on` rules share.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// Subscribes to the ends of programs, and to tool changes when a switch that names rule `id` in
/// its `leftOn` asks for it (`atToolChange`).
void listenForLeftOn(llvm::StringRef id, Subscriptions &to);

/// Reports the switches of rule `id` that are on at the main program's end, or at a tool change:
/// all of them in one finding. Notes show where each was switched on; the fix writes the codes that
/// switch them off. Other events are ignored.
void reportLeftOn(llvm::StringRef id, const Event &event, RuleContext &ctx);

/// A rule that does nothing else.
class LeftOnRule : public Rule {
public:
  explicit LeftOnRule(llvm::StringRef id) : id_(id) {}
  void listen(Subscriptions &to) override { listenForLeftOn(id_, to); }
  void on(const Event &event, RuleContext &ctx) const override { reportLeftOn(id_, event, ctx); }

private:
  llvm::StringRef id_;
};

} // namespace ncvet
