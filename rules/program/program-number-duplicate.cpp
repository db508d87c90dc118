// Two programs of one file have the same number.
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

/// The header line of a listing repeats the program's own: nothing is between the two.
bool isSame(const ProgramInfo &first, const ProgramInfo &second, const Reader &reader) {
  for (const Block &block : blocks(reader, first.begin, second.begin)) {
    if (!block.isEmpty())
      return false;
  }
  return true;
}

class ProgramNumberDuplicate final : public Rule {
public:
  void listen(Subscriptions &to) override {
    fileIsProgram_ = to.dialect().facts->program.fileIsProgram;
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    // (In a file that is one program the numbers are marks, by which control runs on.)
    if (file.index.programs().size() < 2 || fileIsProgram_)
      return;
    for (const ProgramInfo &program : file.index.programs()) {
      if (!program.hasHeader() || program.number < 0)
        continue;
      const ProgramInfo *first = file.index.find(program.number);
      if (first == &program)
        continue;
      if (isSame(*first, program, file.reader))
        continue;
      const auto headerOf = [&](const ProgramInfo &p) {
        return SourceRange{file.source.id(), p.headerBegin, p.headerEnd};
      };
      if (auto finding = ctx.report(headerOf(program)))
        finding
            .message("a second program O{0} in this file: one overwrites the other, calls find one "
                     "of them",
                     program.number)
            .note(headerOf(*first), "the first one");
    }
  }

private:
  bool fileIsProgram_ = false;
};

} // namespace
NCVET_RULE(ProgramNumberDuplicate, program_number_duplicate)
} // namespace ncvet
