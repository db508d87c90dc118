// A block of more characters than the control reads.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class SyntaxBlockTooLong final : public Rule {
public:
  void listen(Subscriptions &to) override { most_ = to.dialect().limits.blockLength; }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (!most_)
      return;
    const llvm::StringRef text = file.source.text();
    for (size_t begin = 0; begin < text.size();) {
      // Lines that end within so many characters from here are short enough, each of them.
      if (const size_t last = lastEnd(text, begin); last != llvm::StringRef::npos) {
        begin = last + 1;
        continue;
      }
      size_t end = text.find('\n', begin);
      if (end == llvm::StringRef::npos)
        end = text.size();
      if (end - begin > most_ && text.slice(begin, begin + most_).contains(' '))
        if (auto finding =
                ctx.report(SourceRange{file.source.id(), uint32_t(begin),
                                       uint32_t(begin + text.slice(begin, end).find(' '))}))
          finding.message("this block has {0} characters, and the control reads {1}: the rest is "
                          "lost",
                          end - begin, most_);
      begin = end + 1;
    }
  }

private:
  /// The last line end in the characters from `begin` on that a line may have; npos: there is none.
  size_t lastEnd(llvm::StringRef text, size_t begin) const {
    const size_t end = text.substr(begin, most_ + 1).rfind('\n');
    return end == llvm::StringRef::npos ? end : begin + end;
  }

  size_t most_ = 0;
};

} // namespace
NCVET_RULE(SyntaxBlockTooLong, syntax_block_too_long)
} // namespace ncvet
