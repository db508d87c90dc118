// A matrix that the control cannot use, or does not know.
#include "analyzer/rule.h"

#include <set>

namespace ncvet {
namespace {

class CoordinateMatrixInvalid final : public Rule {
public:
  void listen(Subscriptions &to) override {
    most_ = size_t(to.option("most", 0));
    to.handleNotices();
    to.onCode([](const CodeInfo &code) {
      return code.action == Action::Reset || naming(code) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) override {
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    if (code.action == Action::Reset)
      names_.clear();
    const WordSpec *spec = naming(code);
    const Word *word = spec ? wordFor(ctx.block(), *spec) : nullptr;
    if (!word || ctx.callDepth() > 0)
      return;
    const std::string name = ctx.text(*word).trim().upper();
    switch (spec->naming) {
    case Naming::Define:
      if (names_.insert(name).second && most_ && names_.size() > most_)
        if (auto finding = ctx.report(event))
          finding.message("`{0}` is matrix {1}: the control keeps {2}", ctx.text(*word),
                          names_.size(), most_);
      break;
    case Naming::Use:
      if (!names_.count(name) && !ctx.before().may(Fact::UnknownCode))
        if (auto finding = ctx.report(*word))
          finding.severity(spec->severity)
              .message("the program has defined no matrix `{0}`", ctx.text(*word));
      break;
    case Naming::Drop:
      names_.erase(name);
      break;
    case Naming::None:
      break;
    }
  }
  void remember(RuleMemory &memory) const override { memory(names_); }

private:
  static constexpr llvm::StringLiteral id{"coordinate-matrix-invalid"};

  static const WordSpec *naming(const CodeInfo &code) {
    for (const WordSpec &spec : code.words)
      if (spec.naming != Naming::None)
        return &spec;
    return nullptr;
  }

  size_t most_ = 0;             ///< matrices that are kept; 0: any number
  std::set<std::string> names_; ///< of those defined, in the order of the text
};

} // namespace
NCVET_RULE(CoordinateMatrixInvalid, coordinate_matrix_invalid)
} // namespace ncvet
