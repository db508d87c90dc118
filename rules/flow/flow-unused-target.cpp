// A subprogram that nothing calls.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/callers.h"

#include "llvm/Support/Path.h"

#include <algorithm>

namespace ncvet {
namespace {

class FlowUnusedTarget final : public Rule {
public:
  void listen(Subscriptions &) override {}

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (!file.complete)
      return;
    const auto programs = file.index.programs();
    // A file of one program is a main program or a subprogram for callers in other files.
    if (programs.size() > 1)
      for (const ProgramInfo &program : programs.drop_front())
        if (program.hasHeader() && program.number >= 0 &&
            !llvm::is_contained(file.calledPrograms, program.number) &&
            endsWithReturn(file, program, ctx.dialect()) && !calledFromElsewhere(program, ctx))
          if (auto finding =
                  ctx.report(SourceRange{file.source.id(), program.headerBegin, program.headerEnd}))
            finding.message("nothing calls program {0}", program.number);
    if (ctx.asked())
      filesBeside(ctx);
    for (const ProgramInfo &program : programs)
      labels(file, program, ctx);
    for (const ProgramInfo &program : programs)
      localSections(file, program, ctx);
  }

private:
  static bool calledFromElsewhere(const ProgramInfo &program, const RuleContext &ctx) {
    return llvm::any_of(callersOf(ctx.unit(), program).places,
                        [&](const CallPlace &call) { return call.unit != &ctx.unit(); });
  }

  /// Advice: subprograms in files of their own that no file of the folder calls.
  static void filesBeside(RuleContext &ctx) {
    for (const std::string &path : uncalledFilesBeside(ctx.unit())) {
      const FileUnit *const unit = ctx.unit().project->open(path);
      const ProgramInfo &program = unit->index.programs().front();
      if (isMacroOfBuilder(program.number))
        continue;
      SourceRange at{unit->source.id(), program.headerBegin, program.headerEnd};
      for (const Block &block : blocks(unit->index, program.body, program.end, headBlocks))
        if (!block.isEmpty()) {
          at = {unit->source.id(), block.begin, block.end};
          break;
        }
      if (auto finding = ctx.report(at))
        finding.severity(Severity::Style)
            .message("no program of this folder calls the subprogram `{0}`",
                     llvm::sys::path::filename(unit->source.display()));
    }
  }

  static constexpr unsigned headBlocks = 100; ///< among which a program's first one is

  /// Codes that the machine's parameters name call programs of these numbers.
  static bool isMacroOfBuilder(int64_t number) { return number >= 9000 && number < 9100; }

  /// Labels that nothing jumps to.
  static void labels(const FileSummary &file, const ProgramInfo &program, RuleContext &ctx) {
    constexpr uint32_t readable = 4u << 20; // a program that long was made by a machine
    if (!ctx.dialect().lexical.commaSeparates || program.end - program.begin > readable)
      return; // no labels there
    Block block;
    for (const auto &label : file.index.labels(program)) {
      if (label.getKey() == ctx.dialect().lexical.endLabel ||
          llvm::is_contained(file.usedLabels, label.getKey().str()))
        continue;
      for (const uint32_t at : label.getValue()) {
        file.reader.read(at, block);
        if (!file.isReached(at))
          continue;
        const SourceRange range{file.source.id(), block.labelBegin, block.labelEnd};
        if (auto finding = ctx.report(range))
          finding.message("nothing leads to the label `{0}`", ctx.text(range));
      }
    }
  }

  static bool endsWithReturn(const FileSummary &file, const ProgramInfo &program,
                             const Dialect &dialect) {
    bool returns = false;
    file.index.eachBlock(
        program.body, program.end,
        [&](uint32_t, const Block &block) {
          if (!block.isEmpty() && block.kind == BlockKind::Normal)
            returns = findCode(dialect, block, {Action::Return}) != nullptr;
          return true;
        },
        [&](const TextPiece &piece) {
          returns &= piece.blocks == 0; // no plain block returns
          return true;
        });
    return returns;
  }

  /// The place after the blocks that run one after the other from the program's begin to one that
  /// ends it; where something else ends them, the program's begin.
  static uint32_t afterMainPart(const FileSummary &file, const ProgramInfo &program,
                                const Dialect &dialect) {
    const SourceRange *const run = llvm::find_if(file.reached, [&](const SourceRange &range) {
      return range.begin <= program.body && program.body < range.end;
    });
    if (run == file.reached.end() || run->end > program.end)
      return program.body;
    Block last;
    readBlockAt(file.source, file.reader, run->end - 1, last);
    return findCode(dialect, last, {Action::Return, Action::ProgramEnd, Action::ProgramEndRewind})
               ? run->end
               : program.body;
  }

  /// Sections after the program's end that begin with a number and end with a return, and that no
  /// call names. Only where the control has local calls.
  static void localSections(const FileSummary &file, const ProgramInfo &program, RuleContext &ctx) {
    if (file.anyNumberUsed || llvm::none_of(ctx.dialect().codes, [](const CodeInfo &code) {
          return code.action == Action::CallLocal;
        }))
      return;
    if (llvm::any_of(file.reached, [&](const SourceRange &range) {
          return range.begin <= program.body && program.end <= range.end;
        }))
      return;
    bool ended = false;
    SourceRange first;
    int64_t number = -1;
    const uint32_t from = afterMainPart(file, program, ctx.dialect());
    if (from != program.body)
      ended = true;
    const auto read = [&](uint32_t, const Block &block) {
      if (block.isEmpty() || block.kind != BlockKind::Normal)
        return true;
      if (ended && number < 0 && block.number >= 0 && !file.isReached(block.begin) &&
          !std::binary_search(file.usedNumbers.begin(), file.usedNumbers.end(), block.number)) {
        number = block.number;
        first = {file.source.id(), block.numberBegin, block.numberEnd};
      }
      const bool returns = findCode(ctx.dialect(), block, {Action::Return}) != nullptr;
      if (returns && number >= 0 && !file.isReached(block.begin))
        if (auto finding = ctx.report(first))
          finding.message("nothing calls the subprogram that begins with block {0}", number);
      if (returns ||
          findCode(ctx.dialect(), block, {Action::ProgramEnd, Action::ProgramEndRewind})) {
        ended = true;
        number = -1;
      }
      return true;
    };
    // What holds no number and no code that ends a program changes nothing.
    file.index.eachBlock(from, program.end, read, [](const TextPiece &) { return true; });
  }
};

} // namespace
NCVET_RULE(FlowUnusedTarget, flow_unused_target)
} // namespace ncvet
