// A program number or file name that breaks the control's rules.
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class ProgramNameInvalid final : public Rule {
public:
  void listen(Subscriptions &to) override {
    names_ = to.dialect().limits.nameLength;
    labels_ = to.dialect().limits.labelLength;
    if (labels_)
      to.on(EventKind::Statement);
    if (names_)
      to.on({EventKind::Return, EventKind::Statement, EventKind::Syntax});
    digitsMin_ = to.dialect().limits.programDigitsMin;
    digitsMax_ = to.dialect().limits.programDigitsMax;
    percent_ = to.dialect().lexical.percentHeader;
    nameLength_ = size_t(to.number("fileNameLength", 0));
    ending_ = to.flag("fileEnding");
    numbersFromOne_ = to.flag("fromOne");
    labelLength_ = size_t(to.dialect().facts->limits.longestLabel);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Return)
      return atReturn(ctx);
    if (event.kind == EventKind::Syntax)
      return badName(ctx.block().issues[event.issue()], ctx);
    const Item &item = ctx.block().items[event.item()];
    if (labels_ && (item.kind == ItemKind::Call || item.kind == ItemKind::Jump)) {
      if (item.nameEnd > item.nameBegin)
        calledName({ctx.source().id(), item.nameBegin, item.nameEnd}, ctx);
      return namedLabels(item, ctx);
    }
    if (labels_ && item.kind == ItemKind::Input)
      return namedLabels(item, ctx);
    if (item.kind != ItemKind::Definition)
      return;
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    const char *why = wrongName(ctx.text(range));
    if (!why && isAddress(ctx.text(range), ctx.dialect()))
      why = "the control knows it as an address";
    if (!why || (!ctx.asked() && followsWrongName(item, ctx)))
      return;
    if (auto finding = ctx.report(range))
      finding.message("`{0}` is no name for a variable: {1}", ctx.text(range), why);
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (ending_)
      ending(file, ctx);
    if (labels_)
      return labels(file, ctx);
    if (names_)
      return named(file, ctx);
    for (const ProgramInfo &program : file.index.programs())
      if (program.hasHeader())
        header(program, file, ctx);
    if (nameLength_ && file.index.programs().front().hasHeader())
      fileName(file, ctx);
  }

private:
  /// `DEF REAL L1,L2,L3`: the first name speaks for the others of its block.
  static bool followsWrongName(const Item &item, const RuleContext &ctx) {
    return llvm::any_of(ctx.block().items, [&](const Item &other) {
      const auto name = ctx.text(SourceRange{ctx.source().id(), other.nameBegin, other.nameEnd});
      return other.kind == ItemKind::Definition && other.begin < item.begin &&
             (wrongName(name) || isAddress(name, ctx.dialect()));
    });
  }

  static void badName(const SyntaxIssue &issue, RuleContext &ctx) {
    if (issue.kind != SyntaxIssueKind::BadName)
      return;
    const SourceRange range = ctx.range(issue);
    // Of variables that have the name of a word syntax-unknown-name speaks.
    if (!ctx.asked() && !llvm::isDigit(ctx.text(range)[0]) &&
        llvm::any_of(ctx.block().items, [&](const Item &item) {
          return item.kind == ItemKind::Definition && item.nameBegin == range.begin;
        }))
      return;
    if (auto finding = ctx.report(range))
      finding.message(llvm::isDigit(ctx.text(range)[0])
                          ? "`{0}` is no name: it has to begin with two letters"
                          : "`{0}` is no name: it is a word of the language",
                      ctx.text(range));
  }

  /// The control lists files with its own ending only.
  static void ending(const FileSummary &file, RuleContext &ctx) {
    const auto &endings = ctx.dialect().extensions;
    const std::string shown = file.source.display();
    const llvm::StringRef ending = llvm::StringRef(shown).rsplit('.').second;
    if (ending.empty() || endings.empty() ||
        llvm::any_of(endings, [&](const auto &one) { return ending.equals_insensitive(one); }))
      return;
    const llvm::StringRef text = file.source.text();
    const size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    const size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    if (auto finding = ctx.report(SourceRange{file.source.id(), uint32_t(begin), uint32_t(end)}))
      finding.severity(Severity::Style)
          .message("the file's ending is `.{0}`: programs of this control have `.{1}`", ending,
                   llvm::StringRef(endings.front()).upper());
  }

  /// A program is called by its name alone.
  static void calledName(SourceRange range, RuleContext &ctx) {
    const llvm::StringRef name = ctx.text(range);
    if (!name.contains('.') && !llvm::any_of(name, [](char c) { return c >= 'a' && c <= 'z'; }))
      return;
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("`{0}` is no name that a call takes: capitals and digits, without an ending",
                   name);
  }

  /// Labels to which a block leads on, written with blanks that do not count.
  static void namedLabels(const Item &item, RuleContext &ctx) {
    for (const Argument &argument : ctx.block().argumentsOf(item)) {
      const SourceRange range{ctx.source().id(), argument.begin, argument.end};
      if (argument.kind != ArgumentKind::Label ||
          !ctx.text(range).split(':').first.trim().contains(' ') || isWrittenSo(range, ctx))
        continue;
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Style)
            .message("blanks of the label `{0}` do not count", ctx.text(range));
    }
  }

  /// The label itself has these blanks: it is reported there.
  static bool isWrittenSo(SourceRange named, RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    Block block;
    for (const auto &label : ctx.index().labels(program))
      for (const uint32_t at : label.getValue()) {
        ctx.index().reader().read(at, block);
        if (ctx.text(SourceRange{named.file, block.labelBegin, block.labelEnd}).trim() ==
            ctx.text(named).trim())
          return true;
      }
    return false;
  }

  /// Of a label only some characters count.
  void labels(const FileSummary &file, RuleContext &ctx) const {
    constexpr size_t readable = 4u << 20; // a program that long was made by a machine
    if (file.source.text().size() > readable)
      return;
    for (const Block &block : blocks(file.reader)) {
      for (const SyntaxIssue &issue : block.issues)
        if (issue.kind == SyntaxIssueKind::BadStatement &&
            ctx.text(SourceRange{file.source.id(), issue.begin, issue.end}) == "[]")
          if (auto finding = ctx.report(SourceRange{file.source.id(), issue.begin, issue.end}))
            finding.message("a label without a name");
      if (!block.hasLabel())
        continue;
      const SourceRange range{file.source.id(), block.labelBegin, block.labelEnd};
      const llvm::StringRef name = ctx.text(range).split(':').first;
      if (name.trim().empty() && !ctx.text(range).empty()) {
        if (auto finding = ctx.report(range))
          finding.message("a label without a name: the text after the colon is a remark");
        continue;
      }
      const size_t letters = name.size() - name.count(' ');
      if (letters == 0)
        if (auto finding = ctx.report(range))
          finding.message("a label without a name: the text after `:` is a remark");
      if (letters == 0 || (letters <= labels_ && !name.trim().contains(' ')))
        continue;
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Style)
            .message(letters > labels_ ? "of the label `{0}` only {1} characters count"
                                       : "blanks of the label `{0}` do not count",
                     ctx.text(range), labels_);
    }
  }

  size_t labels_ = 0; ///< characters of a label that count; 0: all

  /// What is wrong with a name of letters, digits and `_`; null: nothing.
  static const char *wrongName(llvm::StringRef name) {
    const auto letter = [](char c) { return llvm::isAlpha(c) || c == '_'; };
    if (name.size() < 2 || !letter(name[0]) || !letter(name[1]))
      return "it has to begin with two letters";
    return nullptr;
  }

  /// Programs with names: the header's, and the file's that holds it.
  void named(const FileSummary &file, RuleContext &ctx) const {
    const auto programs = file.index.programs();
    ownName(file, ctx);
    unitHeads(file, ctx);
    for (const ProgramInfo &program : programs) {
      labelNames(program, file, ctx);
      if (!program.hasHeader())
        continue;
      storedElsewhere(program, file, ctx);
      const SourceRange range{file.source.id(), program.headerBegin, program.headerEnd};
      const bool numbered = llvm::StringRef(program.name).startswith("L") &&
                            llvm::all_of(program.name.substr(1), llvm::isDigit);
      if (const char *why = numbered ? nullptr : wrongName(program.name)) {
        if (auto finding = ctx.report(range))
          finding.message("`{0}` is no name for a program: {1}", program.name, why);
      } else if (program.name.size() > names_) {
        if (auto finding = ctx.report(range))
          finding.message("`{0}` has {1} characters, and the control takes {2}", program.name,
                          program.name.size(), names_);
      }
    }
    if (programs.size() != 1 || !programs[0].hasHeader())
      return;
    // A file of one program carries its name.
    const std::string shown = file.source.display();
    llvm::StringRef name = shown;
    name = name.substr(name.rfind('/') + 1);
    const auto [stem, ending] = name.rsplit('.');
    const SourceRange range{file.source.id(), programs[0].headerBegin, programs[0].headerEnd};
    const ProgramKind kind = kindOfEnding(ending, ctx.dialect());
    const ProgramKind told = programs[0].kind;
    const bool otherKind = told != ProgramKind::Unknown && told != kind;
    if (kind == ProgramKind::Unknown || (stem.equals_insensitive(programs[0].name) && !otherKind))
      return;
    if (auto finding = ctx.report(range))
      finding
          .severity(Severity::Style) // (where it is copied from a disk it keeps the disk's name)
          .message("`{0}` is in the file `{1}`: the control files it under the name of its "
                   "header",
                   ctx.text(range), name);
  }

  /// `%_N_PART_MPF` begins each unit of an archive: letters, digits and `_`, and what kind it is.
  static void unitHeads(const FileSummary &file, RuleContext &ctx) {
    const llvm::StringRef text = file.source.text();
    // By its first letter, of which there are few: the text may be long.
    for (size_t at = text.find('%'); at != llvm::StringRef::npos; at = text.find('%', at + 1)) {
      if (!text.drop_front(at).startswith("%_N_"))
        continue;
      if (at > 0 && text[at - 1] != '\n' && text[at - 1] != '\r')
        continue;
      const llvm::StringRef line =
          text.drop_front(at).take_until([](char c) { return c == '\r' || c == '\n' || c == ';'; });
      const llvm::StringRef head = line.rtrim();
      const llvm::StringRef name = head.drop_front();
      const bool readable = llvm::all_of(name, [](char c) { return llvm::isAlnum(c) || c == '_'; });
      const llvm::StringRef kind = name.rsplit('_').second;
      const bool known =
          kindOfEnding(kind, ctx.dialect()) != ProgramKind::Unknown ||
          llvm::any_of(ctx.dialect().facts->program.dataKinds,
                       [&](llvm::StringRef one) { return kind.equals_insensitive(one); });
      if (readable && known)
        continue;
      const SourceRange range{file.source.id(), uint32_t(at), uint32_t(at + head.size())};
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message(readable ? "`{0}` heads no kind of file that the control has"
                              : "`{0}`: the name of a unit has letters, digits and `_` only",
                     head);
    }
  }

  /// The name of a file that holds one program without a header: the control stores it so.
  /// Files of other machines' programs are named freely: it is said on demand, or of a control that
  /// the machine profile names.
  void ownName(const FileSummary &file, RuleContext &ctx) const {
    if (!ctx.asked() && !ctx.machine().option("control"))
      return;
    const auto programs = file.index.programs();
    const std::string shown = file.source.display();
    const llvm::StringRef name =
        llvm::StringRef(shown).substr(llvm::StringRef(shown).rfind('/') + 1);
    const auto [stem, ending] = name.rsplit('.');
    if (programs.size() != 1 || programs[0].hasHeader() || stem.startswith("<") ||
        kindOfEnding(ending, ctx.dialect()) == ProgramKind::Unknown)
      return;
    const bool numbered = (stem.startswith("L") || stem.startswith("l")) && stem.size() > 1 &&
                          llvm::all_of(stem.drop_front(), llvm::isDigit);
    const char *why = numbered ? nullptr : wrongName(stem);
    if (!why && !llvm::all_of(stem, [](char c) { return llvm::isAlnum(c) || c == '_'; }))
      why = "it has other characters than letters, digits and `_`";
    if (!why && stem.size() <= names_)
      return;
    const llvm::StringRef text = file.source.text();
    const size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    const size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    auto finding = ctx.report(SourceRange{file.source.id(), uint32_t(begin), uint32_t(end)});
    if (!finding)
      return;
    finding.severity(Severity::Style);
    if (why)
      finding.message("the file is `{0}`, and the control takes no program of that name: {1}", name,
                      why);
    else
      finding.message("the file is `{0}`: its name has {1} characters, and the control takes {2}",
                      name, stem.size(), names_);
  }

  /// An address of several letters.
  static bool isAddress(llvm::StringRef name, const Dialect &dialect) {
    return llvm::any_of(dialect.addressNames, [&](const std::string &address) {
      return name.equals_insensitive(address);
    });
  }

  /// `X1:` looks like a word, and is read as one where it is jumped to.
  void labelNames(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) const {
    constexpr size_t readable = 4u << 20; // a program that long was made by a machine
    if (program.end - program.begin > readable)
      return;
    Block block;
    for (const auto &label : file.index.labels(program)) {
      const bool tooLong = labelLength_ && label.getKey().size() > labelLength_;
      const CodeIndex own = ctx.dialect().keyword(label.getKey());
      // Many words of the language are names elsewhere; those of modes are taken by none.
      const bool isWord = own != noCode && (ctx.dialect().codes[own].group != noGroup ||
                                            ctx.dialect().codes[own].stopsPreparation);
      const bool wrong = !label.getKey().startswith("_") && wrongName(label.getKey());
      if (!wrong && !tooLong && !isWord)
        continue;
      for (const uint32_t at : label.getValue()) {
        file.reader.read(at, block);
        const SourceRange range{file.source.id(), block.labelBegin, block.labelEnd};
        auto finding = ctx.report(range);
        if (finding && wrong)
          finding.message("`{0}` is no name for a label: {1}", ctx.text(range),
                          wrongName(label.getKey()));
        else if (finding && isWord)
          finding.message("`{0}` is no name for a label: it is a word of the language",
                          ctx.text(range));
        else if (finding)
          finding.message("the label `{0}` has {1} characters, and the control takes {2}",
                          ctx.text(range), label.getKey().size(), labelLength_);
      }
    }
  }

  /// The line after the header says where the control files the program.
  static void storedElsewhere(const ProgramInfo &program, const FileSummary &file,
                              RuleContext &ctx) {
    const llvm::StringRef text = file.source.text().slice(program.headerEnd, program.end);
    const size_t line = text.find_first_not_of(" \t\r\n");
    if (line == llvm::StringRef::npos || !text.drop_front(line).startswith(";$PATH="))
      return;
    const llvm::StringRef path =
        text.drop_front(line).take_until([](char c) { return c == '\r' || c == '\n'; });
    const bool main = program.kind == ProgramKind::Main;
    if (!(main
              ? path.contains_insensitive("_N_SPF_DIR")
              : program.kind == ProgramKind::Subprogram && path.contains_insensitive("_N_MPF_DIR")))
      return;
    const auto begin = uint32_t(program.headerEnd + line);
    if (auto finding =
            ctx.report(SourceRange{file.source.id(), begin, begin + uint32_t(path.rtrim().size())}))
      finding.severity(Severity::Warning)
          .message(main ? "`{0}` files a main program among the subprograms"
                        : "`{0}` files a subprogram among the main programs",
                   path.rtrim());
  }

  /// A called program lies in a file of subprograms.
  void atReturn(RuleContext &ctx) const {
    const auto &endings = ctx.dialect().subprogramExtensions;
    if (ctx.callDepth() == 0 || endings.empty() || ctx.index().programs()[0].hasHeader())
      return;
    const std::string shown = ctx.source().display();
    const llvm::StringRef ending = llvm::StringRef(shown).rsplit('.').second;
    if (llvm::any_of(endings,
                     [&](const std::string &one) { return ending.equals_insensitive(one); }) ||
        ending.empty())
      return;
    const uint32_t begin = ctx.index().programs()[0].body;
    const uint32_t end = uint32_t(std::min<size_t>(ctx.source().text().find_first_of("\r\n", begin),
                                                   ctx.source().text().size()));
    if (auto finding = ctx.report(SourceRange{ctx.source().id(), begin, end}))
      finding.severity(Severity::Warning)
          .message("this file is called as a subprogram, and its ending is `.{0}`", ending);
  }

  bool numbersFromOne_ = false; ///< 0 is no number of a program
  size_t names_ = 0;            ///< most characters of a program's name; 0: programs have numbers

  /// `<NAME>` as a program's header.
  static void bracketed(llvm::StringRef text, SourceRange range, RuleContext &ctx) {
    constexpr size_t most = 32;
    const llvm::StringRef name = text.drop_front().take_until([](char c) { return c == '>'; });
    const bool readable = llvm::all_of(
        name, [](char c) { return llvm::isAlnum(c) || llvm::StringRef("-+_.").contains(c); });
    if (readable && name.size() <= most)
      return;
    if (auto finding = ctx.report(range))
      finding.message("`{0}` is no name of a program: letters, digits and `- + _ .`, {1} at most",
                      text, most);
  }

  void header(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) const {
    const SourceRange range{file.source.id(), program.headerBegin, program.headerEnd};
    const llvm::StringRef text = ctx.text(range).trim();
    llvm::StringRef rest = text;
    rest.consume_front("%");
    rest = rest.ltrim();
    const bool letter = rest.consume_front("O") || rest.consume_front("o") ||
                        (!percent_ && rest.consume_front(":"));
    rest = rest.ltrim();
    if (ctx.dialect().lexical.namedPrograms && rest.startswith("<"))
      return bracketed(rest, range, ctx);
    const llvm::StringRef digits = rest.take_while(llvm::isDigit);
    rest = rest.drop_front(digits.size());
    if (!letter || digits.empty() || !rest.empty()) {
      if (auto finding = ctx.report(range))
        finding.message("`{0}` is no program number: {1}", text, wanted());
    } else if (program.number == 0 && numbersFromOne_) {
      if (auto finding = ctx.report(range))
        // (CAM systems write `O0000` where the number is given at the panel)
        finding.severity(digits.size() < 4 ? std::nullopt : std::optional(Severity::Style))
            .message("`{0}`: the control has no program number 0", text);
    } else if (digitsMax_ && digits.size() > digitsMax_) {
      if (auto finding = ctx.report(range))
        finding.message("`{0}` has {1} digits: {2}", text, digits.size(), wanted());
    } else if (digits.size() < digitsMin_) {
      if (auto finding = ctx.report(range))
        finding.message("`{0}` has {1} digits: {2}", text, digits.size(), wanted())
            .severity(Severity::Style);
    } else if (percent_) {
      afterNumber(range, file, ctx);
    }
  }

  /// Only a name in brackets may follow the number.
  static void afterNumber(SourceRange number, const FileSummary &file, RuleContext &ctx) {
    const llvm::StringRef line =
        file.source.text().drop_front(number.end).take_until([](char c) { return c == '\n'; });
    const llvm::StringRef text = line.split('(').first.trim();
    if (text.empty())
      return;
    const auto begin = uint32_t(number.end + line.find(text));
    if (auto finding = ctx.report(SourceRange{number.file, begin, begin + uint32_t(text.size())}))
      finding.message("`{0}` after the program number: only a name in brackets may follow it",
                      text);
  }

  std::string wanted() const {
    std::string text = "it is the letter O and ";
    if (!digitsMax_)
      return text + "digits";
    text += digitsMin_ == digitsMax_ ? "exactly " : "at most ";
    return text + std::to_string(digitsMax_) + " digits";
  }

  void fileName(const FileSummary &file, RuleContext &ctx) const {
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
  size_t labelLength_ = 0; ///< most characters of a label; 0: any number
  bool ending_ = false;    ///< the ending of the file's name is looked at
};

} // namespace
NCVET_RULE(ProgramNameInvalid, program_name_invalid)
} // namespace ncvet
