// A program number that belongs to the control.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ProgramNameReserved final : public Rule {
public:
  void listen(Subscriptions &to) override { reserved_ = to.dialect().limits.reservedPrograms; }

  void finish(const FileSummary &file, RuleContext &ctx) override {
    for (const ProgramInfo &program : file.index.programs()) {
      if (!program.hasHeader() || !llvm::is_contained(reserved_, int(program.number)))
        continue;
      if (auto finding =
              ctx.report(SourceRange{file.source.id(), program.headerBegin, program.headerEnd}))
        finding.message("the control writes O{0} itself: a program of this number is lost",
                        program.number);
    }
  }

private:
  llvm::ArrayRef<int> reserved_;
};

} // namespace
NCVET_RULE(ProgramNameReserved, program_name_reserved)
} // namespace ncvet
