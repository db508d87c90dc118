// Selected blocks, made a subprogram.
#include "formats/dialect/control_facts.h"
#include "lsp/features/writing/new_lines.h"
#include "lsp/features/writing/rewrite_words.h"
#include "lsp/features/writing/rewriter.h"
#include "lsp/features/writing/rewritings.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

namespace ncvet::lsp {

namespace {

/// Numbers that are tried for the new program, and numbers after `PART` for a new name.
constexpr int64_t mostTries = 1000;
/// Between the number of the last selected block and that of the return.
constexpr int64_t numberStep = 10;

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

/// Whether programs have names, and each is a file of its own.
bool namesFiles(const Dialect &dialect) {
  return !dialect.lexical.callMark.empty() || !dialect.subprogramExtensions.empty();
}

/// `L<PART1>`, or the bare name.
std::string callOf(const Dialect &dialect, const std::string &name) {
  const std::string &mark = dialect.lexical.callMark;
  return mark + name + (llvm::StringRef(mark).endswith("<") ? ">" : "");
}

bool isLower(llvm::StringRef text) { return text.lower() == text && text.upper() != text; }

class Extractor : Rewriter {
public:
  explicit Extractor(Selection &selection)
      : Rewriter(selection, "Make the selection a subprogram") {}

  Rewriting run() {
    if (isExtractable()) {
      if (dialect_.lexical.arithmetic == Arithmetic::Ngc)
        betweenBrackets();
      else if (namesFiles(dialect_))
        byName();
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

  /// `PART1`, and the file PART1.SPF beside that of the text; in an archive a further program.
  void byName() {
    const CallCodes codes = callCodes(dialect_);
    const std::string name = freeName();
    if (!codes.back)
      return void(refuse("the control has no code that returns"));
    if (name.empty())
      return void(refuse("no name is free"));
    const ProgramInfo &own =
        selection_.snapshot().unit().index.programAt(selection_.blocks().front().begin);
    const llvm::StringRef lineEnd = lineEndOf(text_);
    const std::string code =
        (body() + numberAfter() + "M" + codeDigits(*codes.back, "") + lineEnd).str();
    replaceBy(callOf(dialect_, name));
    if (own.hasHeader())
      return inArchive(own, name, code);
    const std::string path = pathOf(name);
    if (path.empty())
      return void(refuse("the text is no file yet"));
    if (llvm::sys::fs::exists(path) || selection_.isOpen(path))
      return void(refuse("there is a file " + llvm::sys::path::filename(path).str() + " already"));
    create(path, code);
  }

  /// A name that is not in use yet where the control would look for it.
  std::string freeName() {
    Snapshot &snapshot = selection_.snapshot();
    for (int64_t i = 1; i <= mostTries; ++i) {
      std::string name = "PART" + std::to_string(i);
      if (!snapshot.project().findProgram(snapshot.unit(), name).second &&
          !snapshot.project().liesElsewhere(snapshot.unit(), name) &&
          text_.find_insensitive(name) == llvm::StringRef::npos)
        return name;
    }
    return {};
  }

  /// In small letters where the file of the text has them.
  std::string pathOf(const std::string &name) const {
    const llvm::StringRef own = selection_.snapshot().source().path();
    llvm::StringRef ending = llvm::sys::path::extension(own);
    if (own.empty())
      return {};
    const bool small = isLower(ending);
    std::string file = name;
    if (dialect_.subprogramExtensions.empty())
      file += ending;
    else
      file += "." + llvm::StringRef(dialect_.subprogramExtensions.front()).upper();
    llvm::SmallString<128> path(llvm::sys::path::parent_path(own));
    llvm::sys::path::append(path, small ? llvm::StringRef(file).lower() : file);
    return path.str().str();
  }

  /// `N60 ` where every block has a number.
  std::string numberAfter() const {
    const Block &last = selection_.blocks().back();
    if (!dialect_.facts->program.everyBlockNumbered || last.number < 0)
      return {};
    return "N" + std::to_string(last.number + numberStep) + " ";
  }

  /// The head of the program, and the line after it that says where the control keeps it, with the
  /// new name.
  void inArchive(const ProgramInfo &own, const std::string &name, const std::string &code) {
    const llvm::StringRef lineEnd = lineEndOf(text_);
    std::string head = text_.slice(own.headerBegin, own.headerEnd).rtrim().str();
    const size_t at = llvm::StringRef(head).find_insensitive(own.name);
    const size_t kind = llvm::StringRef(head).find_insensitive("_MPF");
    if (own.name.empty() || at == std::string::npos || kind == std::string::npos)
      return void(refuse("the head of the program is not one that another program could have"));
    head.replace(kind, 4, "_SPF");
    head.replace(at, own.name.size(), name);
    const llvm::StringRef next = text_.substr(own.headerEnd).ltrim("\r\n");
    if (next.startswith_insensitive(";$PATH="))
      head += (lineEnd + next.take_until([](char c) { return c == '\r' || c == '\n'; })).str();
    const auto end = uint32_t(text_.size());
    edit(end, end, ((text_.endswith("\n") ? "" : lineEnd.str()) + head + lineEnd.str() + code));
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
