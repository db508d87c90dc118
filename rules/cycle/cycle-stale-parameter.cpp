// A cycle takes a value that was meant for another one.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/condition.h"

#include <map>
#include <set>

namespace ncvet {
namespace {

struct CycleStaleParameterMemory {
  /// Whom the value of a variable serves.
  struct Meant {
    CodeIndex given = noCode; ///< the code in whose block it was given last
    CodeIndex taken = noCode; ///< the last code that took it
  };
  std::map<uint64_t, Meant> meant; ///< by variable
};

class CycleStaleParameter final : public StatefulRule<CycleStaleParameterMemory> {
public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    kept_ = to.dialect().facts->cycles.valuesInVariables;
    for (const CodeInfo &code : to.dialect().codes)
      for (const WordSpec &spec : code.words) {
        if (spec.variable)
          ofCycles_.insert(spec.variable);
        if (spec.variable && spec.need != Need::Optional)
          parameters_.insert(spec.variable);
      }
    to.on(EventKind::Statement);
    to.onCode([](const CodeInfo &code) {
      return llvm::any_of(code.words,
                          [](const WordSpec &w) { return w.variable || w.role == Role::Shift; }) ||
             llvm::any_of(code.stores, [](const Store &s) { return s.variable; }) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement)
      return assigned(ctx.block().items[event.item()], ctx);
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    shiftFromPeck(event, code, ctx);
    for (const WordSpec &spec : code.words) {
      if (!spec.variable || !holds(spec.when, &code, ctx.conditions()))
        continue;
      const auto last = memory().meant.find(spec.variable);
      if (wordFor(ctx.block(), spec)) {
        memory().meant[spec.variable] = {code.base, code.base};
        continue;
      }
      if (mayBeGivenOnly(spec) || last == memory().meant.end() ||
          ctx.before().commons.given(spec.variable) != Truth::Yes)
        continue;
      // A value that the control sets is there for whoever may leave the word out.
      if (last->second.taken == noCode && spec.need == Need::Optional)
        continue;
      if (last->second.taken == code.base || shared(spec) ||
          (kept_ && last->second.taken != noCode &&
           meansTheSame(spec, ctx.dialect().codes[last->second.taken]))) {
        if (kept_ && !spec.absent && (code.action == Action::Cycle || isForm(spec, code)))
          keeps(event, spec, code, ctx);
        continue;
      }
      const CodeInfo &other = ctx.dialect().codes[last->second.given];
      if (auto finding = ctx.report(event))
        finding.severity(Severity::Warning)
            .message("`{0}` has no {1} in its block and takes the one that was given for `{2}`",
                     code.name, spec.name, other.name);
      last->second.taken = code.base;
    }
    for (const Store &store : code.stores)
      if (kept_ && !store.value.empty() && parameters_.count(store.variable))
        memory().meant[store.variable] = {code.base, noCode};
  }

private:
  static constexpr llvm::StringLiteral id{"cycle-stale-parameter"};

  /// A bore shifts its tool by the word that the cycle before it has left for its pecks.
  static void shiftFromPeck(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const AddressMask shift = addressesOf(code, Role::Shift);
    const CodeInfo *active = ctx.before().activeCode(ctx.dialect(), StandardGroup::Cycle);
    if (code.action != Action::Cycle || !shift || ctx.block().hasAny(shift) || !active ||
        active->action != Action::Cycle || !(addressesOf(*active, Role::Peck) & shift))
      return;
    const auto peck = kept(ctx.before(), *active, Role::Peck);
    if (!peck || *peck == 0)
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` shifts the tool by the pecks of `{1}`, {2}: its block gives no shift",
                   code.name, active->name, *peck);
  }

  /// A value that a block of its own gives is meant for whatever comes.
  void assigned(const Item &item, RuleContext &ctx) const {
    const uint64_t key = item.kind == ItemKind::Assignment ? ctx.block().keyOf(item.target) : 0;
    if (!ofCycles_.count(key))
      return sleepAtBlock();
    const auto meant = memory().meant.find(key);
    if (meant == memory().meant.end())
      return;
    // A cycle that runs in every block takes it too.
    const CodeInfo *active = ctx.before().activeCode(ctx.dialect(), StandardGroup::Cycle);
    if (active && active->firesOnEveryBlock && !ctx.find({Action::CycleCancel, Action::Cycle}) &&
        llvm::any_of(active->words,
                     [&](const WordSpec &w) { return w.variable == meant->first; })) {
      meant->second = {active->base, active->base};
      return;
    }
    const bool inCycle = llvm::any_of(ctx.block().words, [&](const Word &word) {
      const CodeIndex code = codeOf(ctx.dialect(), word);
      return code != noCode && llvm::any_of(ctx.dialect().codes[code].words,
                                            [](const WordSpec &w) { return w.variable; });
    });
    if (!inCycle)
      memory().meant.erase(meant);
  }

  /// The value of the run before: what a form is told by, or advice.
  static void keeps(const Event &event, const WordSpec &spec, const CodeInfo &code,
                    RuleContext &ctx) {
    const bool form = spec.need == Need::Optional;
    if (auto finding = ctx.report(event))
      finding.severity(form ? Severity::Warning : Severity::Style)
          .message(form ? "`{0}` has no {1} in its block, and the value that an earlier block gave "
                          "still acts"
                        : "`{0}` has no {1} in its block and keeps the value of an earlier block",
                   code.name, spec.name);
  }

  bool kept_ = false;             ///< values that stay the same are reported too
  std::set<uint64_t> ofCycles_;   ///< keys of the variables that codes take
  std::set<uint64_t> parameters_; ///< keys of the variables that some code requires

  /// A word that may be beside the code, and of which the table says nothing more.
  static bool mayBeGivenOnly(const WordSpec &spec) {
    return spec.need == Need::Optional && spec.role == Role::None && spec.note.empty();
  }
  /// A word without which a profile is worked along in another way.
  static bool isForm(const WordSpec &spec, const CodeInfo &code) {
    return code.action == Action::ProfileBegin && spec.need == Need::Optional && !spec.absent &&
           spec.role == Role::None;
  }
  /// The other code calls the variable what this one calls it.
  static bool meansTheSame(const WordSpec &spec, const CodeInfo &other) {
    return !spec.note.empty() && llvm::any_of(other.words, [&](const WordSpec &its) {
      return its.variable == spec.variable && its.note == spec.note;
    });
  }
  /// Depth, heights and feed mean the same to every cycle.
  static bool shared(const WordSpec &spec) {
    return spec.role == Role::Depth || spec.role == Role::Retract || spec.role == Role::Height ||
           spec.role == Role::Feed;
  }
};

} // namespace
NCVET_RULE(CycleStaleParameter, cycle_stale_parameter)
} // namespace ncvet
