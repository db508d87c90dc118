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
    whole_ = to.dialect().facts->text.wholeCodes == 1;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.word->address != letterAddress('G') || (whole_ && event.word->decimals > 0) ||
        ctx.find({Action::MacroCall, Action::MacroModal}))
      return;
    if (remapped_)
      return memory().own.meet(event.word->codeNumber(), ctx.range(*event.word));
    if (auto finding = ctx.report(event))
      finding.message("`{0}` does not exist on this control: the block is refused",
                      ctx.text(*event.word));
  }

  void finish(const FileSummary &, RuleContext &ctx) const override {
    if (remapped_)
      memory().own.report(ctx, "a code of this control nor remapped in the machine profile");
  }

private:
  bool remapped_ = false; ///< the machine may define codes: all of a file are told once
  bool whole_ = false;    ///< a code with decimals is no whole number, as another rule says
};

} // namespace
NCVET_RULE(BlockUnknownGCode, block_unknown_g_code)
} // namespace ncvet
