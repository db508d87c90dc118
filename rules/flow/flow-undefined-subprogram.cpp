// A called program, or a locally called block, exists nowhere.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"
#include "analyzer/rule/rule.h"
#include "analyzer/rule/text_answers.h"
#include "formats/dialect/control_facts.h"
#include "formats/dialect/measure.h"

#include <set>

namespace ncvet {
namespace {

/// Programs from here on are kept in the control's protected memory: macros of the machine builder
/// and of probing systems.
constexpr double firstProtected = 8000;

/// A program of the machine's builder, by the control's table.
bool isProtected(const Flow &flow, int32_t first) {
  constexpr double last = 9999;
  return first && flow.kind != FlowKind::CallLocal && flow.target.isConstant() &&
         flow.target.number.value() >= first && flow.target.number.value() <= last;
}

/// A program that is called by its name, now or after every move from here on.
bool isNamed(const Flow &flow) {
  return flow.kind == FlowKind::CallNamed || flow.kind == FlowKind::CallModal;
}

/// Two letters that are next to each other have changed places.
bool isSwapped(llvm::StringRef a, llvm::StringRef b) {
  if (a.size() != b.size())
    return false;
  size_t at = 0;
  while (at < a.size() && a[at] == b[at])
    ++at;
  return at + 1 < a.size() && a[at] == b[at + 1] && a[at + 1] == b[at] &&
         a.drop_front(at + 2) == b.drop_front(at + 2);
}

/// The cycle or instruction of the control whose number the called name has, and almost its
/// letters: `CYLCE81`; null: there is none.
const CodeInfo *mistypedFor(const RuleContext &ctx) {
  constexpr size_t shortest = 5; // shorter names are like each other by chance
  const std::string text = ctx.text(ctx.flowRange()).split('(').first.trim().upper();
  const llvm::StringRef name = text, letters = name.rtrim("0123456789");
  if (letters.size() + 1 < shortest)
    return nullptr;
  for (const CodeInfo &code : ctx.dialect().codes) {
    const llvm::StringRef known = code.name, own = known.rtrim("0123456789");
    // Two letters that are changed round are two; words without a number are many.
    const unsigned most = own.size() < known.size() ? 2 : 1;
    if (!code.letter && own.size() >= shortest && own != letters &&
        known.drop_front(own.size()) == name.drop_front(letters.size()) &&
        (own.edit_distance(letters, true, most) <= most || isSwapped(own, letters)))
      return &code;
  }
  return nullptr;
}

/// How the control calls the block of this program that has the number of the called program;
/// empty: there is none that begins a subprogram, or the control calls programs only.
std::string callOfBlock(const Flow &flow, const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  if (flow.kind == FlowKind::CallLocal || isNamed(flow) || !flow.target.isConstant() ||
      dialect.lexical.flowWords)
    return "";
  const auto number = int64_t(flow.target.number.value());
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  const auto place =
      resolveBlock(ctx.index(), program, Reference::toBlock(number), ctx.block().begin);
  if (!place || *place < ctx.block().begin)
    return "";
  // After the end of the program, or after a return: nothing else leads there.
  Block block;
  ctx.index().read(*place, block);
  if (!readBack(ctx, block) ||
      !findCode(dialect, block, {Action::ProgramEnd, Action::ProgramEndRewind, Action::Return}))
    return "";
  const auto local = llvm::find_if(dialect.codes, [](const CodeInfo &code) {
    return code.action == Action::CallLocal && code.letter == 'M' && !code.foreign;
  });
  if (local == dialect.codes.end())
    return "";
  const AddressMask word = addressesOf(*local, Role::Sequence);
  return formatted("{0} {1}{2}", local->name, dialect.alternatives(word), number);
}

/// Whether a contour is called that is turned.
bool turnsContour(const RuleContext &ctx) {
  const Flow &flow = ctx.outcome().flow;
  return flow.kind == FlowKind::Contour && flow.code != noCode &&
         has(ctx.dialect().codes[flow.code], CycleTrait::TurnsContour);
}

/// Whether the program has a label of the name that is called.
bool isLabel(const RuleContext &ctx) {
  const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
  const llvm::StringRef name = ctx.text(ctx.flowRange()).trim('"');
  return resolveBlock(ctx.index(), program, Reference::toLabel(name), ctx.block().begin)
      .has_value();
}

class FlowUndefinedSubprogram final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) const override {
    const auto issue = event.flowIssue();
    const Flow &flow = ctx.outcome().flow;
    const bool local = flow.kind == FlowKind::CallLocal;
    const bool contour = issue == FlowIssue::UnknownBlock && flow.kind == FlowKind::Contour &&
                         flow.code != noCode && !turnsContour(ctx);
    if (issue != FlowIssue::UnknownProgram && !(issue == FlowIssue::UnknownBlock && local) &&
        !contour)
      return;
    // A macro of the control itself is not part of any folder of programs.
    const bool builtIn =
        flow.macro && flow.target.isConstant() && flow.target.number.value() >= firstProtected;
    if (local && ctx.dialect().facts->program.callsBlocks) // told as a target that is missing
      return;
    if (isProtected(flow, ctx.dialect().limits.protectedPrograms))
      return;
    if (const std::string call = callOfBlock(flow, ctx); !call.empty()) {
      if (auto finding = ctx.report(ctx.flowRange(), event.certain))
        finding.severity(Severity::Warning)
            .message("`{0}` calls a program that was not found, and this one has a block of that "
                     "number: `{1}` calls it",
                     ctx.text(ctx.flowRange()), call);
      return;
    }
    // A subprogram may belong to a set of the machine's builder, which lies on the control.
    if (isNamed(flow) && ctx.index().programAt(ctx.block().begin).kind == ProgramKind::Subprogram &&
        !mistypedFor(ctx))
      return;
    auto finding = ctx.report(ctx.flowRange(), event.certain && !builtIn);
    if (!finding)
      return;
    if (contour)
      finding.message("`{0}` is a contour between two labels, and this program does not have both: "
                      "the control stops here",
                      ctx.text(ctx.flowRange()));
    else
      tell(finding, local, builtIn, ctx);
  }

private:
  /// By file: see `uncalled`.
  TextAnswers<FileId, int64_t> uncalled_;

  /// The number of the one program of the file that returns, and that no block of it calls, where
  /// the call is the only one without a target; -1: there is none.
  int64_t uncalled(const RuleContext &ctx) const {
    const Flow &flow = ctx.outcome().flow;
    if (flow.macro || isNamed(flow) || !flow.target.isConstant())
      return -1;
    return uncalled_.of(ctx.source().id(), [&] { return onlyUncalled(ctx); });
  }

  static int64_t onlyUncalled(const RuleContext &ctx) {
    std::set<int64_t> called, returning;
    std::set<std::pair<int64_t, int64_t>> calls; ///< the caller, and what it calls
    constexpr unsigned most = 20'000;            // blocks
    unsigned read = 0;
    for (const ProgramInfo &program : ctx.index().programs())
      for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
        if (++read > most)
          return -1;
        if (program.number >= 0 && findCode(ctx.dialect(), block, {Action::Return}))
          returning.insert(program.number);
        if (!findCode(ctx.dialect(), block,
                      {Action::CallProgram, Action::MacroCall, Action::MacroModal}))
          continue;
        const Word *const number = block.find(letterAddress('P'));
        if (!number || !number->isNumber())
          return -1; // what it calls the text does not say
        called.insert(int64_t(number->value()) % 10'000);
        calls.emplace(program.number, int64_t(number->value()) % 10'000);
      }
    size_t open = 0;
    int64_t missing = -1;
    for (const int64_t number : called)
      if (llvm::none_of(ctx.index().programs(), [&](const ProgramInfo &program) {
            return program.number % 10'000 == number;
          })) {
        ++open;
        missing = number;
      }
    int64_t orphan = -1;
    for (const int64_t number : returning) {
      if (called.count(number % 10'000))
        continue;
      if (orphan >= 0)
        return -1;
      orphan = number;
    }
    // One that calls the missing program itself is another one.
    return open == 1 && !calls.count({orphan, missing}) ? orphan : -1;
  }

  void tell(FindingBuilder &finding, bool local, bool builtIn, const RuleContext &ctx) const {
    const Flow &flow = ctx.outcome().flow;
    const CodeInfo *const meant = isNamed(flow) ? mistypedFor(ctx) : nullptr;
    if (meant)
      finding.severity(Severity::Warning)
          .message("`{0}` calls a program that was not found: was `{1}` meant?",
                   ctx.text(ctx.flowRange()), meant->name);
    else if (local) // no folder of the control can hold it
      finding.severity(Severity::Error)
          .message("`{0}` calls a block that this program does not have: the control stops here",
                   ctx.text(ctx.flowRange()));
    else if (flow.kind == FlowKind::Contour && isLabel(ctx))
      finding.message("`{0}` calls a program that was not found, and this one has a label of that "
                      "name: a contour between two labels names both",
                      ctx.text(ctx.flowRange()));
    else if (const int64_t orphan = uncalled(ctx); orphan >= 0)
      finding.severity(Severity::Warning)
          .message("`{0}` calls a program that was not found, and nothing calls O{1} of this file: "
                   "was that meant?",
                   ctx.text(ctx.flowRange()), orphan);
    else if (builtIn)
      finding.severity(Severity::Style)
          .message("`{0}` calls a program that was not found: nothing is known of what it does",
                   ctx.text(ctx.flowRange()));
    else if (ctx.dialect().limits.protectedPrograms ||
             ((isNamed(flow) || turnsContour(ctx)) &&
              !ctx.dialect().facts->program.folders.empty()))
      // The builder's programs lie in folders of the control.
      finding.severity(Severity::Style)
          .message("`{0}` calls a program that was not found: unless it lies on the control, this "
                   "one stops here",
                   ctx.text(ctx.flowRange()));
    else
      finding.message("`{0}` calls a program that was not found: the control stops here",
                      ctx.text(ctx.flowRange()));
  }
};

} // namespace
NCVET_RULE(FlowUndefinedSubprogram, flow_undefined_subprogram)
} // namespace ncvet
