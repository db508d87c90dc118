// A G code that this control's table does not have.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

#include <map>

namespace ncvet {
namespace {

struct BlockUnknownGCodeMemory {
  std::map<uint32_t, std::pair<FileId, uint32_t>> first; ///< where each code was met first
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
    if (remapped_) {
      const auto place = std::pair(ctx.source().id(), event.word->offset);
      if (memory().first.try_emplace(event.word->codeNumber(), place).first->second != place)
        return;
      if (auto finding = ctx.report(event))
        finding.message("`{0}` is neither a code of this control nor remapped in the machine "
                        "profile: what it does is not known",
                        ctx.text(*event.word));
      return;
    }
    if (auto finding = ctx.report(event))
      finding.message("`{0}` does not exist on this control: the block is refused",
                      ctx.text(*event.word));
  }

private:
  bool remapped_ = false; ///< the machine may define codes: each is told once
  bool whole_ = false;    ///< a code with decimals is no whole number, as another rule says
};

} // namespace
NCVET_RULE(BlockUnknownGCode, block_unknown_g_code)
} // namespace ncvet
