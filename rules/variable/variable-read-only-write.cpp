// A system variable that the control alone writes.
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

class VariableReadOnlyWrite final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().readOnly.empty() || !to.dialect().readOnlyNumbers.empty())
      to.on(EventKind::Statement);
    stops_ = size_t(to.number("stopRanges", 0));
  }

  void on(const Event &event, RuleContext &ctx) const override {
    sleepAtBlock();
    const Item &item = ctx.block().items[event.item()];
    if (item.kind != ItemKind::Assignment)
      return;
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    const llvm::StringRef name = ctx.text(range).split('[').first;
    for (const std::string &readOnly : ctx.dialect().readOnly)
      if (name.equals_insensitive(readOnly) ||
          (llvm::StringRef(readOnly).endswith("_") && name.startswith_insensitive(readOnly)))
        if (auto finding = ctx.report(range))
          finding.message("`{0}` can only be read: the control refuses the block", name);
    const auto number = ctx.block().numberIn(item.target);
    const auto which = number ? rangeOf(int64_t(*number), ctx.dialect()) : std::nullopt;
    if (!which)
      return;
    if (auto finding = ctx.report(range))
      finding.severity(*which < stops_ ? Severity::Error : Severity::Warning)
          .message("`#{0}` can only be read: the control writes it itself", int64_t(*number));
  }

private:
  /// Which of the table's ranges of variables that are only read holds the number.
  static std::optional<size_t> rangeOf(int64_t number, const Dialect &dialect) {
    const std::vector<int> &ranges = dialect.readOnlyNumbers;
    for (size_t i = 0; i + 1 < ranges.size(); i += 2)
      if (number >= ranges[i] && number <= ranges[i + 1])
        return i / 2;
    return std::nullopt;
  }

  size_t stops_ = 0; ///< in how many of the ranges, from the first, the control refuses to write
};

} // namespace
NCVET_RULE(VariableReadOnlyWrite, variable_read_only_write)
} // namespace ncvet
