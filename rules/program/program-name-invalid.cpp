// A program number or file name that breaks the control's rules.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ProgramNameInvalid final : public Rule {
public:
  void listen(Subscriptions &to) override {
    digitsMin_ = to.dialect().limits.programDigitsMin;
    digitsMax_ = to.dialect().limits.programDigitsMax;
    percent_ = to.dialect().lexical.percentHeader;
    nameLength_ = size_t(to.option("fileNameLength", 0));
  }

  void finish(const FileSummary &file, RuleContext &ctx) override {
    for (const ProgramInfo &program : file.index.programs())
      if (program.hasHeader())
        header(program, file, ctx);
    if (nameLength_ && file.index.programs().front().hasHeader())
      fileName(file, ctx);
  }

private:
  void header(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) {
    const SourceRange range{file.source.id(), program.headerBegin, program.headerEnd};
    const llvm::StringRef text = ctx.text(range).trim();
    llvm::StringRef rest = text;
    rest.consume_front("%");
    rest = rest.ltrim();
    const bool letter = rest.consume_front("O") || rest.consume_front("o") ||
                        (!percent_ && rest.consume_front(":"));
    rest = rest.ltrim();
    const llvm::StringRef digits = rest.take_while(llvm::isDigit);
    rest = rest.drop_front(digits.size());
    if (!letter || digits.empty() || !rest.empty()) {
      if (auto finding = ctx.report(range))
        finding.message("`{0}` is no program number: {1}", text, wanted());
    } else if (digitsMax_ && digits.size() > digitsMax_) {
      if (auto finding = ctx.report(range))
        finding.message("`{0}` has {1} digits: {2}", text, digits.size(), wanted());
    } else if (digits.size() < digitsMin_) {
      if (auto finding = ctx.report(range))
        finding.message("`{0}` has {1} digits: {2}", text, digits.size(), wanted())
            .severity(Severity::Style);
    }
  }

  std::string wanted() const {
    std::string text = "it is the letter O and ";
    if (!digitsMax_)
      return text + "digits";
    text += digitsMin_ == digitsMax_ ? "exactly " : "at most ";
    return text + std::to_string(digitsMax_) + " digits";
  }

  void fileName(const FileSummary &file, RuleContext &ctx) {
    llvm::StringRef name = file.source.display();
    name = name.substr(name.rfind('/') == llvm::StringRef::npos ? 0 : name.rfind('/') + 1);
    const llvm::StringRef stem = name.rsplit('.').first;
    if (stem.size() <= nameLength_ || stem.startswith("<"))
      return;
    const ProgramInfo &first = file.index.programs().front();
    if (auto finding =
            ctx.report(SourceRange{file.source.id(), first.headerBegin, first.headerEnd}))
      finding
          .message(
              "the file name `{0}` is longer than the {1} characters that the control's disk takes",
              stem, nameLength_)
          .severity(Severity::Style);
  }

  uint16_t digitsMin_ = 1, digitsMax_ = 0;
  bool percent_ = false;
  size_t nameLength_ = 0;
};

} // namespace
NCVET_RULE(ProgramNameInvalid, program_name_invalid)
} // namespace ncvet
