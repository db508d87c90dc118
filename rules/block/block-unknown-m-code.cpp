// An M code that neither this control's table nor the machine profile has.
#include "analyzer/facts/machines_own_codes.h"
#include "formats/dialect/control_facts.h"

#include <map>

namespace ncvet {
namespace {

struct BlockUnknownMCodeMemory {
  std::map<int64_t, std::pair<FileId, uint32_t>> first; ///< where each code was met first
  MachinesOwnCodes own; ///< of a control whose every code may be made
};

class BlockUnknownMCode final : public StatefulRule<BlockUnknownMCodeMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::UnknownCode);
    above_ = to.number("above", -1);
    remapped_ = to.dialect().facts->program.remapsInIni;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.word->address != letterAddress('M') ||
        ctx.find({Action::MacroCall, Action::MacroModal}))
      return;
    const Interval number = ctx.value(*event.word);
    if (above_ >= 0 && (!number.isConstant() || number.value() <= above_))
      return;
    // Once for each code: a machine's own codes come again and again.
    const auto place = std::pair(ctx.source().id(), event.word->offset);
    const int64_t code = number.isConstant() ? int64_t(number.value()) : event.word->mantissa;
    if (remapped_)
      return memory().own.meet(code, ctx.range(*event.word));
    if (memory().first.try_emplace(code, place).first->second != place)
      return;
    if (wasStart(code, ctx)) {
      if (auto finding = ctx.report(event))
        finding.severity(Severity::Warning)
            .message("`{0}` is no code of this control, and the spindle that its block gives a "
                     "speed is stopped: `{1}` was meant",
                     ctx.text(*event.word), startOf(ctx.dialect())->name);
      return;
    }
    if (auto finding = ctx.report(event))
      finding.message("`{0}` is neither a code of this control nor named in the machine profile: "
                      "what it does is not known",
                      ctx.text(*event.word));
  }

  void finish(const FileSummary &, RuleContext &ctx) const override {
    if (remapped_)
      memory().own.report(ctx, "a code of this control nor named in the machine profile");
  }

private:
  /// The code that starts the spindle; null: there is none.
  static const CodeInfo *startOf(const Dialect &dialect) {
    const auto start = llvm::find_if(dialect.codes, [](const CodeInfo &code) {
      return code.letter == 'M' && code.action == Action::SpindleCw;
    });
    return start == dialect.codes.end() ? nullptr : &*start;
  }

  /// The block gives a speed to a spindle that is stopped, and has no other M code: another digit
  /// of the code was meant.
  static bool wasStart(int64_t code, const RuleContext &ctx) {
    constexpr int64_t digits = 10, twoDigits = 100;
    const CodeInfo *const start = startOf(ctx.dialect());
    return start && code < twoDigits && code % digits == int64_t(start->number) / 10 % digits &&
           ctx.block().has(letterAddress('S')) && ctx.before().spindle == spindleOff &&
           !ctx.before().may(Fact::UnknownCode) && !(ctx.block().repeated & maskOf('M'));
  }

  bool remapped_ = false; ///< the machine may define codes
  double above_ = -1;     ///< codes up to here may be the machine builder's
};

} // namespace
NCVET_RULE(BlockUnknownMCode, block_unknown_m_code)
} // namespace ncvet
