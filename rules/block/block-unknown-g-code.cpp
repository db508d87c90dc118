// A G code that this control's table does not have.
#include "analyzer/facts/machines_own_codes.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct BlockUnknownGCodeMemory {
  MachinesOwnCodes own; ///< of a machine that may define codes
};

class BlockUnknownGCode final : public StatefulRule<BlockUnknownGCodeMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::UnknownCode);
    remapped_ = to.flag("remapped");
    macros_ = to.flag("macros");
    whole_ = to.dialect().facts->text.wholeCodes == 1;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.word->address != letterAddress('G') || (whole_ && event.word->decimals > 0) ||
        ctx.find({Action::MacroCall, Action::MacroModal}))
      return;
    if (remapped_)
      return memory().own.meet(event.word->codeNumber(), ctx.range(*event.word));
    if (macros_ && ctx.index().definition(ctx.index().programAt(ctx.block().begin),
                                          ctx.text(*event.word).upper()))
      return;
    // A number of the builder's own beside nothing else may be the name of a macro.
    const bool mayBeMacro = macros_ && event.word->codeNumber() >= firstOfMacros &&
                            ctx.block().words.size() == 1 && ctx.block().items.empty();
    auto finding = ctx.report(event, mayBeMacro ? false : event.certain);
    if (!finding)
      return;
    if (mayBeMacro)
      finding.severity(Severity::Warning)
          .message("`{0}` does not exist on this control: unless the machine's macros define it, "
                   "the block is refused",
                   ctx.text(*event.word));
    else
      finding.message("`{0}` does not exist on this control: the block is refused",
                      ctx.text(*event.word));
  }

  void finish(const FileSummary &, RuleContext &ctx) const override {
    if (remapped_)
      memory().own.report(ctx, "a code of this control nor remapped in the machine profile");
  }

private:
  static constexpr int64_t firstOfMacros = 100; // fewer digits are the control's

  bool macros_ = false;   ///< macros may have the names of codes
  bool remapped_ = false; ///< the machine may define codes: all of a file are told once
  bool whole_ = false;    ///< a code with decimals is no whole number, as another rule says
};

} // namespace
NCVET_RULE(BlockUnknownGCode, block_unknown_g_code)
} // namespace ncvet
