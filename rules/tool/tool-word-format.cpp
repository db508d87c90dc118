// A lathe's tool word that does not name station and offset with two digits each.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ToolWordFormat final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().isLathe())
      to.on(EventKind::ToolWord);
  }

  void on(const Event &event, RuleContext &ctx) override {
    const Word &word = *event.word;
    // T0 and T00 cancel the offset; what an expression gives is not written here.
    if (!word.isNumber() || word.mantissa == 0 || word.has(wordMalformed))
      return;
    const llvm::StringRef digits = ctx.text(word).drop_front().ltrim(" +-");
    const size_t count = digits.take_while([](char c) { return c >= '0' && c <= '9'; }).size();
    const bool point = !word.isWhole() || word.has(wordPoint) || word.has(wordMinus);
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
};

} // namespace
NCVET_RULE(ToolWordFormat, tool_word_format)
} // namespace ncvet
