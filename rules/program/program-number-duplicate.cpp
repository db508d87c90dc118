// Two programs of one file, or of one folder, have the same number.
#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"
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
    if (fileIsProgram_)
      return;
    if (ctx.asked())
      filesBeside(file, ctx);
    if (file.index.programs().size() < 2)
      return;
    for (const ProgramInfo &program : file.index.programs()) {
      if (program.hasHeader() && program.number < 0 &&
          (ctx.dialect().lexical.namedPrograms || !ctx.dialect().facts->program.dataKinds.empty()))
        named(program, file, ctx);
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
  /// The line after the header that says where the control files the program, as archives have it;
  /// empty: there is none.
  static llvm::StringRef folderOf(const ProgramInfo &program, const FileSummary &file) {
    const llvm::StringRef rest = file.source.text().slice(program.headerEnd, program.end).ltrim();
    const llvm::StringRef line = rest.take_until([](char c) { return c == '\r' || c == '\n'; });
    return line.startswith(";$PATH") ? line.split('=').second.trim() : "";
  }

  /// `<NAME>` twice.
  static void named(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) {
    const auto headerOf = [&](const ProgramInfo &p) {
      return SourceRange{file.source.id(), p.headerBegin, p.headerEnd};
    };
    const llvm::StringRef name = ctx.text(headerOf(program)).trim();
    for (const ProgramInfo &first : file.index.programs()) {
      if (&first == &program)
        return;
      if (!first.hasHeader() || first.number >= 0 || ctx.text(headerOf(first)).trim() != name ||
          folderOf(first, file) != folderOf(program, file) || isSame(first, program, file.reader))
        continue;
      if (auto finding = ctx.report(headerOf(program)))
        finding
            .message("a second program `{0}` in this file: one overwrites the other, calls find "
                     "one of them",
                     name)
            .note(headerOf(first), "the first one");
      return;
    }
  }

  /// Advice: a control's memory holds a number once, folders of a computer several times. The first
  /// file tells of the others.
  static void filesBeside(const FileSummary &file, RuleContext &ctx) {
    Project *const project = ctx.unit().project;
    if (!project || file.source.path().empty())
      return;
    for (const ProgramInfo &program : file.index.programs()) {
      if (!program.hasHeader() || program.number < 0)
        continue;
      for (const std::string &path : project->filesOf(ctx.unit(), program.number))
        if (path > file.source.path())
          if (FileUnit *const other = project->open(path))
            inFile(*other, program, ctx);
    }
  }

  static void inFile(const FileUnit &other, const ProgramInfo &program, RuleContext &ctx) {
    const ProgramInfo *second = other.index.find(program.number);
    if (!second || !second->hasHeader())
      return;
    if (auto finding =
            ctx.report(SourceRange{other.source.id(), second->headerBegin, second->headerEnd}))
      finding.severity(Severity::Warning)
          .message("a second program O{0} in this folder: in the memory of the control one "
                   "overwrites the other",
                   program.number)
          .note(SourceRange{ctx.source().id(), program.headerBegin, program.headerEnd},
                "the first one");
  }

  bool fileIsProgram_ = false;
};

} // namespace
NCVET_RULE(ProgramNumberDuplicate, program_number_duplicate)
} // namespace ncvet
