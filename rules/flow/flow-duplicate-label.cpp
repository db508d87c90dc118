// A label that two blocks of a program carry.
#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"
#include "analyzer/rule/rule.h"

#include <set>

namespace ncvet {
namespace {

class FlowDuplicateLabel final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::FlowIssue);
    nearest_ = to.flag("nearestWins");
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.flowIssue() != FlowIssue::DuplicateLabel)
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding
          .message("the label of `{0}` is taken: an earlier bracket has it",
                   ctx.text(ctx.flowRange()))
          .note(ctx.flowRelated(), "it begins here");
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    constexpr size_t readable = 4u << 20; // a program that long was made by a machine
    if (!ctx.dialect().lexical.commaSeparates || file.source.text().size() > readable)
      return; // no labels there
    Block block;
    for (const ProgramInfo &program : file.index.programs())
      for (const auto &label : file.index.labels(program)) {
        const std::vector<uint32_t> &places = label.getValue();
        if (places.size() < 2 || label.getKey() == ctx.dialect().lexical.endLabel)
          continue;
        const bool chooses = choosesBetween(program, label.getKey(), places, file);
        // Two branches may have their own.
        if (!chooses && nearest_ && !ctx.asked())
          continue;
        file.reader.read(places[0], block);
        const SourceRange first{file.source.id(), block.labelBegin, block.labelEnd};
        file.reader.read(places[1], block);
        const SourceRange range{file.source.id(), block.labelBegin, block.labelEnd};
        if (auto finding = ctx.report(range)) {
          finding
              .message("the label `{0}` is at two blocks: a jump finds only one of them",
                       ctx.text(range))
              .note(first, "it is here too");
          if (!chooses)
            finding.severity(Severity::Style);
        }
      }
  }

private:
  /// Whether a jump has two of the label's blocks on the side to which it looks, and takes the
  /// nearer one: the other, which no jump takes, may have been meant.
  static bool choosesBetween(const ProgramInfo &program, llvm::StringRef label,
                             llvm::ArrayRef<uint32_t> places, const FileSummary &file) {
    std::set<uint32_t> taken, passed;
    for (const Block &block : blocks(file.reader, program.body, program.end))
      for (const Item &item : block.items) {
        if (item.kind != ItemKind::Jump)
          continue;
        for (const Argument &target : block.argumentsOf(item)) {
          if (target.kind != ArgumentKind::Label ||
              file.reader.labelKey(file.source.text(target.begin, target.end)) != label)
            continue;
          const bool back = searchOf(searchKind(item, target)) == Search::Backward;
          std::set<uint32_t> side;
          for (const uint32_t place : places)
            if (back ? place <= block.begin : place > block.begin)
              side.insert(place);
          if (side.empty())
            continue;
          const uint32_t nearest = back ? *side.rbegin() : *side.begin();
          taken.insert(nearest);
          side.erase(nearest);
          passed.insert(side.begin(), side.end());
        }
      }
    return llvm::any_of(passed, [&](uint32_t place) { return !taken.count(place); });
  }

  bool nearest_ = false; ///< a jump takes the nearest label of its direction
};

} // namespace
NCVET_RULE(FlowDuplicateLabel, flow_duplicate_label)
} // namespace ncvet
