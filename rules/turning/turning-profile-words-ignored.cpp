// Words of a profile that the roughing cycle does not obey.
#include "analyzer/facts/turning_profile.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class TurningProfileWordsIgnored final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    onlyWithoutOwn_ = to.dialect().facts->turning.ownWordsCount;
    corners_ = to.dialect().facts->turning.roughingIgnoresCorners;
    finish_ = to.dialect().facts->turning.finishIgnoresWords;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.outcome().flow.kind != FlowKind::Profile)
      return sleepInShape();
    const CodeInfo &cycle = ctx.code(event);
    const bool finishing = cycle.cycle == CycleKind::Finish;
    if (finishing && !finish_)
      return;
    const auto ways = profileWays(ctx);
    const Profile &profile = ways.front().profile; // with all that may run
    AddressMask technology = lettersMask("FST");
    if (onlyWithoutOwn_) // roughing has its own value
      technology &= ~ctx.block().addresses;
    if (!finishing && !finish_)
      technology &= ~takenByFinish(profile, technology, ctx);
    const bool sharp = corners_ && !finishing && cycle.cycle != CycleKind::PatternRepeat;
    for (const ProfileBlock &entry : profile.blocks) {
      const bool line = entry.moves && entry.motionKnown && entry.motion == MotionKind::Feed;
      for (const Word &word : entry.block.words) {
        const AddressMask bit = maskOf(word.address);
        const bool corner = sharp && line &&
                            (bit & (lettersMask("IKR") | maskOf(commaR) | maskOf(commaC))) &&
                            !llvm::any_of(entry.codes, [&](const CodeUse &use) {
                              return ctx.code(use).action == Action::CompensationOff;
                            });
        const bool angle = sharp && line && (bit & (maskOf('A') | maskOf(commaA))) &&
                           (word.address == commaA ||
                            ctx.dialect().addresses[word.address].kind == AddressKind::Parameter);
        if (!(bit & technology) && !corner && !angle)
          continue;
        const SourceRange at{ctx.source().id(), word.offset, entry.block.endOf(word)};
        if (auto finding = ctx.report(at, event.certain && entry.block.skip < 0)) {
          if (corner)
            finding.message(
                "`{0}` roughs along this profile without its corners: the shape stays sharp "
                "at `{1}`",
                cycle.name, ctx.text(at));
          else if (angle)
            finding.message(
                "`{0}` roughs along this profile by X and Z words alone: `{1}` is ignored",
                cycle.name, ctx.text(at));
          else
            finding.message("`{1}` inside the profile does nothing while `{0}` {2}", cycle.name,
                            ctx.text(at), finishing ? "finishes" : "roughs");
          finding.note(ctx.blockRange(), "the cycle that works along this profile");
        }
      }
    }
  }

private:
  /// The words that a cycle further down takes from the same profile to finish it: it has none of
  /// its own. Nothing where the user asks for every word that roughing does not obey.
  static AddressMask takenByFinish(const Profile &profile, AddressMask words, RuleContext &ctx) {
    constexpr unsigned furthest = 100; // blocks
    const Word *const first = ctx.block().find(letterAddress('P'));
    const Word *const last = ctx.block().find(letterAddress('Q'));
    if (ctx.asked() || profile.blocks.empty() || !first || !last)
      return 0;
    const auto isSame = [](const Word *word, const Word &own) {
      return word && word->isNumber() && own.isNumber() && word->value() == own.value();
    };
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block :
         blocks(ctx.index(), profile.blocks.back().block.next, program.end, furthest))
      if (isSame(block.find(letterAddress('P')), *first) &&
          isSame(block.find(letterAddress('Q')), *last) && finishes(block, ctx.dialect()))
        return words & ~block.addresses;
    return 0;
  }

  static bool finishes(const Block &block, const Dialect &dialect) {
    return llvm::any_of(codesOf(dialect, block), [&](CodeIndex code) {
      return dialect.codes[code].cycle == CycleKind::Finish;
    });
  }

  bool onlyWithoutOwn_ = false, corners_ = false;
  bool finish_ = false; ///< a finishing cycle does not obey F, S and T either
};

} // namespace
NCVET_RULE(TurningProfileWordsIgnored, turning_profile_words_ignored)
} // namespace ncvet
