// A program of steps that only the control's own editor can read.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class ProgramStepsUnchecked final : public Rule {
public:
  void listen(Subscriptions &to) override { heads_ = to.dialect().facts->program.stepHeads; }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    constexpr size_t searched = 4096; // the head is among the first lines
    const llvm::StringRef text = file.source.text().take_front(searched);
    for (const std::string &head : heads_) {
      const size_t at = text.find_insensitive(head + "(");
      if (at == llvm::StringRef::npos)
        continue;
      const SourceRange range{file.source.id(), uint32_t(at), uint32_t(at + head.size())};
      if (auto finding = ctx.report(range))
        finding.message("`{0}` begins a program of steps: what a step does only the control's "
                        "editor knows, and none of them is checked",
                        ctx.text(range));
      return;
    }
  }

private:
  std::vector<std::string> heads_; ///< calls with which such programs begin
};

} // namespace
NCVET_RULE(ProgramStepsUnchecked, program_steps_unchecked)
} // namespace ncvet
