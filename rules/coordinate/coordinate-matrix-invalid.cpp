// A matrix that the control cannot use, or does not know.
#include "analyzer/rule/rule.h"

#include <vector>

namespace ncvet {
namespace {

struct CoordinateMatrixInvalidMemory {
  static constexpr uint8_t unused = 0xFF;

  struct Matrix {
    std::string name;
    SourceRange where;     ///< its definition
    uint8_t kind = unused; ///< index of the switch by which it is switched on
  };
  std::vector<Matrix> matrices; ///< that are defined
};

class CoordinateMatrixInvalid final : public StatefulRule<CoordinateMatrixInvalidMemory> {
public:
  void listen(Subscriptions &to) override {
    for (const SwitchInfo &kind : to.dialect().switches)
      most_.push_back(kind.mostNamed);
    to.handleNotices();
    to.onCode([](const CodeInfo &code) {
      return code.action == Action::Reset || naming(code) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    if (code.action == Action::Reset)
      memory().matrices.clear();
    const WordSpec *spec = naming(code);
    const Word *word = spec ? wordFor(ctx.block(), *spec) : nullptr;
    if (!word)
      return;
    const std::string name = ctx.text(*word).trim().upper();
    const auto known = llvm::find_if(
        memory().matrices, [&](const Memory::Matrix &matrix) { return matrix.name == name; });
    switch (spec->naming) {
    case Naming::Define:
      if (known != memory().matrices.end())
        known->where = ctx.range(*word);
      else
        memory().matrices.push_back({name, ctx.range(*word), unused});
      break;
    case Naming::Use:
      if (known != memory().matrices.end())
        return use(*known, code.effect.index, ctx);
      // What calls a program may have defined it.
      if (ctx.callDepth() == 0 && !ctx.before().may(Fact::UnknownCode))
        if (auto finding = ctx.report(*word))
          finding.severity(spec->severity)
              .message("the program has defined no matrix `{0}`", ctx.text(*word));
      break;
    case Naming::Drop:
      if (known != memory().matrices.end())
        memory().matrices.erase(known);
      else if (ctx.callDepth() == 0 && !ctx.before().may(Fact::UnknownCode))
        if (auto finding = ctx.report(*word)) // another program may have left it there
          finding.severity(Severity::Warning)
              .message("the program has defined no matrix `{0}` that could be deleted",
                       ctx.text(*word));
      break;
    case Naming::None:
      break;
    }
  }

private:
  static constexpr llvm::StringLiteral id{"coordinate-matrix-invalid"};

  static constexpr uint8_t unused = Memory::unused;

  /// What switches a matrix on says of which kind it is, and the control keeps some of each.
  void use(Memory::Matrix &matrix, uint8_t kind, RuleContext &ctx) const {
    if (matrix.kind != unused || kind >= most_.size())
      return;
    matrix.kind = kind;
    const auto kept = size_t(
        llvm::count_if(memory().matrices, [&](const Memory::Matrix &m) { return m.kind == kind; }));
    if (!most_[kind] || kept <= most_[kind])
      return;
    if (auto finding = ctx.report(matrix.where))
      finding.message("`{0}` is matrix {1} of its kind: the control keeps {2}", matrix.name, kept,
                      most_[kind]);
  }

  static const WordSpec *naming(const CodeInfo &code) {
    for (const WordSpec &spec : code.words)
      if (spec.naming != Naming::None)
        return &spec;
    return nullptr;
  }

  std::vector<size_t> most_; ///< by switch: matrices of its kind that are kept; 0: any number
};

} // namespace
NCVET_RULE(CoordinateMatrixInvalid, coordinate_matrix_invalid)
} // namespace ncvet
