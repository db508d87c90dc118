// Selected blocks, made a subprogram.
#include "formats/dialect/control_facts.h"
#include "lsp/features/writing/new_lines.h"
#include "lsp/features/writing/rewrite_words.h"
#include "lsp/features/writing/rewriter.h"
#include "lsp/features/writing/rewritings.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet::lsp {

namespace {

/// Numbers that are tried for the new program.
constexpr int64_t mostTries = 1000;

/// How a control that names its programs by numbers calls one and returns from it.
struct CallCodes {
  const CodeInfo *call = nullptr, *back = nullptr;
  bool areKnown() const { return call && back; }
};

bool namesProgram(const CodeInfo &code) {
  return llvm::any_of(code.words, [](const WordSpec &word) {
    return word.role == Role::Program && word.any & maskOf('P');
  });
}

CallCodes callCodes(const Dialect &dialect) {
  CallCodes codes;
  for (const CodeInfo &code : dialect.codes) {
    if (code.letter != 'M')
      continue;
    if (!codes.call && code.action == Action::CallProgram && !code.elsewhere && namesProgram(code))
      codes.call = &code;
    if (!codes.back && code.action == Action::Return)
      codes.back = &code;
  }
  return codes;
}

class Extractor : Rewriter {
public:
  explicit Extractor(Selection &selection)
      : Rewriter(selection, "Make the selection a subprogram") {}

  Rewriting run() {
    if (isExtractable()) {
      if (dialect_.lexical.arithmetic == Arithmetic::Ngc)
        betweenBrackets();
      else
        asProgram();
    }
    return finish();
  }

private:
  bool isExtractable() {
    if (dialect_.lexical.blocksSpanLines)
      refuse("blocks of this control span lines");
    else if (selection_.blocks().size() < 2)
      refuse("a block alone is no subprogram");
    else
      selection_.run(result_.refused);
    return result_.refused.empty();
  }

  /// The selected lines, with a line end after the last.
  std::string body() const {
    const uint32_t begin = selection_.blocks().front().begin, end = selection_.blocks().back().end;
    return (text_.slice(begin, end) + lineEndOf(text_)).str();
  }
  void replaceBy(const std::string &call) {
    const Block &first = selection_.blocks().front();
    // The call has the number of the first block: what leads there leads to the call.
    const std::string number = first.numberEnd > first.numberBegin
                                   ? (text_.slice(first.numberBegin, first.numberEnd) + " ").str()
                                   : "";
    replaceBlocks(number + call);
  }

  /// `M98 P2`, and a program O0002 after the others of the file.
  void asProgram() {
    const CallCodes codes = callCodes(dialect_);
    FileUnit &unit = selection_.snapshot().unit();
    const ProgramInfo &own = unit.index.programAt(selection_.begin());
    if (!codes.areKnown() || own.number < 0 || !own.hasHeader())
      return void(refuse("the control calls no program of the same file by its number"));
    const llvm::StringRef head = text_.slice(own.headerBegin, own.headerEnd).trim();
    const llvm::StringRef address = head.take_until(llvm::isDigit);
    if (address != "O" && address != ":")
      return void(refuse("the head of the program is not one that another program could have"));
    int64_t number = own.number + 1;
    const int64_t past = number + mostTries;
    while (number < past && isTaken(number))
      ++number;
    if (number == past)
      return void(refuse("no number is free"));
    const llvm::StringRef lineEnd = lineEndOf(text_);
    std::string digits = std::to_string(number);
    const size_t width = head.size() - address.size();
    if (digits.size() < width)
      digits.insert(0, width - digits.size(), '0');
    replaceBy("M" + codeDigits(*codes.call, "") + " P" + digits);
    const uint32_t at = afterPrograms();
    const bool isOnOwnLine = at == 0 || text_[at - 1] == '\n';
    edit(at, at,
         (llvm::Twine(isOnOwnLine ? "" : lineEnd) + address + digits + lineEnd + body() + "M" +
          codeDigits(*codes.back, "") + lineEnd)
             .str());
  }

  bool isTaken(int64_t number) {
    return selection_.snapshot()
               .project()
               .findProgram(selection_.snapshot().unit(), number)
               .second != nullptr;
  }

  /// Before the tape mark that ends the text, or at its end.
  uint32_t afterPrograms() const {
    const llvm::ArrayRef<uint32_t> marks = selection_.snapshot().unit().index.tapeMarks();
    return !marks.empty() && marks.back() > selection_.begin() ? marks.back()
                                                               : uint32_t(text_.size());
  }

  /// `o<part> call`, and the subprogram before the first block: a call finds what is written
  /// before it.
  void betweenBrackets() {
    const FileIndex &index = selection_.snapshot().unit().index;
    std::string name;
    for (unsigned i = 1; name.empty(); ++i) {
      const std::string tried = "part" + std::to_string(i);
      if (text_.find_insensitive("<" + tried + ">") == llvm::StringRef::npos)
        name = "o<" + tried + ">";
    }
    const uint32_t at = index.programAt(selection_.begin()).body;
    if (llvm::any_of(index.subprograms(), [&](uint32_t head) { return head < selection_.begin(); }))
      return void(refuse("there are subprograms before the selection"));
    const llvm::StringRef lineEnd = lineEndOf(text_);
    if (at == selection_.blocks().front().begin)
      return void(refuse("the selection begins with the program"));
    edit(at, at, (name + " sub" + lineEnd + body() + name + " endsub" + lineEnd).str());
    replaceBy(name + " call");
  }
};

} // namespace

Rewriting extractSubprogram(Selection &selection) { return Extractor(selection).run(); }

} // namespace ncvet::lsp
