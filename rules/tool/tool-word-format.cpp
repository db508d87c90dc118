// A tool word that does not have the digits of this control: station and offset on lathes.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

#include <cmath>

namespace ncvet {
namespace {

struct ToolWordFormatMemory {
  bool four = false, more = false; ///< words of up to four digits, and of more, were met
};

class ToolWordFormat final : public StatefulRule<ToolWordFormatMemory> {
public:
  void listen(Subscriptions &to) override {
    digits_ = to.dialect().facts->limits.toolDigits;
    any_ = to.dialect().facts->tools.anyDigits;
    named_ = to.dialect().facts->tools.cuttingEdges;
    pairs_ = to.flag("pairs");
    if (to.dialect().isLathe() || digits_ != 0 || named_ || pairs_)
      to.on(EventKind::ToolWord);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Word &word = *event.word;
    if (named_)
      return withoutName(word, ctx);
    if (digits_ != 0 && word.has(wordExpression))
      return computed(word, ctx);
    // T0 and T00 cancel the offset; what an expression gives is not written here.
    if (!word.isNumber() || word.mantissa == 0 || word.has(wordMalformed))
      return;
    const llvm::StringRef digits = ctx.text(word).drop_front().ltrim(" +-");
    const size_t count = digits.take_while([](char c) { return c >= '0' && c <= '9'; }).size();
    if (pairs_)
      return pair(word, digits.take_front(count), ctx);
    if (digits_ != 0) {
      if (count > digits_)
        if (auto finding = ctx.report(word))
          finding.message("`{0}` has {1} digits: a tool's number has at most {2}", ctx.text(word),
                          count, digits_);
      return;
    }
    const bool point = !word.isWhole() || word.has(wordPoint) || word.has(wordMinus);
    if (any_ && !point)
      return mixed(word, count, ctx);
    if ((count == 3 || count == 4) && !point)
      return;
    auto finding = ctx.report(word);
    if (!finding)
      return;
    if (point)
      finding.message("`{0}` is no tool: station and offset are whole numbers of two digits each",
                      ctx.text(word));
    else if (count < 3)
      finding.message(
          "`{0}` names no offset: the control wants station and offset, two digits each",
          ctx.text(word));
    else
      finding.message("`{0}` has {1} digits: the control wants station and offset, two digits each",
                      ctx.text(word), count);
  }

private:
  /// `T0404` where the whole number is that of the tool.
  static void pair(const Word &word, llvm::StringRef digits, RuleContext &ctx) {
    if (digits.size() != 4 || digits.front() != '0' || digits.take_front(2) != digits.drop_front(2))
      return;
    if (auto finding = ctx.report(word))
      finding.severity(Severity::Warning)
          .message("`{0}` is tool {1} here: station and offset in one word are those of a lathe's "
                   "control",
                   ctx.text(word), int64_t(word.value()));
  }
  bool pairs_ = false; ///< a word of two pairs of digits is told

  /// `T=""`.
  static void withoutName(const Word &word, RuleContext &ctx) {
    const llvm::StringRef text = ctx.text(word);
    const llvm::StringRef name = text.split('=').second.trim();
    if (name.size() < 2 || !name.startswith("\"") || !name.endswith("\"") ||
        !name.drop_front().drop_back().trim().empty())
      return;
    if (auto finding = ctx.report(word))
      finding.severity(Severity::Warning).message("`{0}` names no tool: the name is empty", text);
  }

  bool named_ = false; ///< tools have names, and edges for their offsets
  /// How the digits are split is set on the machine: once for all words of a program.
  void mixed(const Word &word, size_t count, RuleContext &ctx) const {
    const bool mixes = count > 4 ? memory().four : memory().more && count > 2;
    memory().four |= count == 3 || count == 4;
    memory().more |= count > 4;
    if (!mixes)
      return;
    if (auto finding = ctx.report(word))
      finding.severity(Severity::Style)
          .message("`{0}` has {1} digits, other tool words of this program have {2}: the machine "
                   "splits all of them into station and offset at one place",
                   ctx.text(word), count, count > 4 ? "four at most" : "more");
  }

  /// `T<FTI(R1)>` where R1 is known and no number of a tool.
  void computed(const Word &word, RuleContext &ctx) const {
    const Interval value = ctx.value(word);
    if (!value.isConstant() ||
        (value.value() >= 0 && value.value() < std::pow(10.0, double(digits_))))
      return;
    if (auto finding = ctx.report(word))
      finding.message("`{0}` is {1}: a tool's number is positive and has at most {2} digits",
                      ctx.text(word), value.value(), digits_);
  }

  bool any_ = false;    ///< the machine says how many digits there are
  unsigned digits_ = 0; ///< a mill's tool number has at most so many
};

} // namespace
NCVET_RULE(ToolWordFormat, tool_word_format)
} // namespace ncvet
