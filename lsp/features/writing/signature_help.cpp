// Signature help: formats of the table, and parameters of programs.
#include "lsp/features/writing/signature_help.h"

#include "analyzer/program/block_reading.h"
#include "interp/evaluate/condition.h"
#include "interp/state/executed_block.h"
#include "interp/value/macro_argument.h"
#include "lsp/features/cursor_context.h"
#include "lsp/features/showing/word_help.h"
#include "lsp/features/word_use.h"

namespace ncvet::lsp {

namespace {

/// Blocks of a program in which its parameters are looked for: they are at its begin.
constexpr unsigned mostBlocksToParameters = 50;

/// Writes a signature, parameter by parameter.
class SignatureWriter {
public:
  /// `first`: the text before the first parameter.
  explicit SignatureWriter(std::string head, llvm::StringRef first = {}) {
    signature_.label = std::move(head);
    signature_.label += first;
  }

  void add(llvm::StringRef separator, llvm::StringRef name, std::string documentation) {
    if (!signature_.parameters.empty())
      signature_.label += separator;
    const auto begin = uint32_t(signature_.label.size());
    signature_.label += name;
    signature_.parameters.push_back(
        {begin, uint32_t(signature_.label.size()), std::move(documentation)});
  }
  Signature finish(llvm::StringRef tail, int active, std::string documentation) {
    signature_.label += tail;
    signature_.active = active < int(signature_.parameters.size()) ? active : -1;
    signature_.documentation = std::move(documentation);
    return std::move(signature_);
  }

private:
  Signature signature_;
};

/// The format of a code whose arguments are a list.
Signature ofArguments(const CodeInfo &code, llvm::StringRef open, llvm::StringRef separator,
                      llvm::StringRef close, unsigned active) {
  SignatureWriter writer(open.str());
  unsigned most = 0;
  for (const WordSpec &spec : code.words)
    most = std::max(most, spec.position);
  for (unsigned position = 1; position <= most; ++position) {
    const WordSpec *found = nullptr;
    for (const WordSpec &spec : code.words)
      if (spec.position == position)
        found = &spec;
    writer.add(separator, found && !found->name.empty() ? found->name : "–",
               found ? specHelp(*found) : std::string());
  }
  return writer.finish(close, int(active), code.title);
}

/// The code that an instruction with this name and first argument is; null: none.
const CodeInfo *instruction(const Dialect &dialect, llvm::StringRef name, llvm::StringRef first) {
  CodeIndex index = dialect.keyword((name + ":" + first).str());
  if (index == noCode)
    index = dialect.keyword(name);
  return index == noCode ? nullptr : &dialect.codes[index];
}

/// `NAME(REAL A, INT B)` of a program that another block names.
std::optional<Signature> ofProgram(Snapshot &snapshot, llvm::StringRef name, unsigned active) {
  const Project::Found found = snapshot.project().findProgram(snapshot.unit(), name);
  if (!found.first || !found.second)
    return std::nullopt;
  const Reader &reader = *found.first->reader;
  const llvm::StringRef text = reader.text();
  for (const Block &block :
       blocks(reader, found.second->begin, found.second->end, mostBlocksToParameters)) {
    for (const Item &item : block.items) {
      if (item.kind != ItemKind::Parameters)
        continue;
      SignatureWriter writer(name.str() + "(");
      for (const Argument &argument : block.argumentsOf(item))
        writer.add(", ", found.first->source.displayText(text.slice(argument.begin, argument.end)),
                   argument.byReference ? "gives its value back" : "");
      return writer.finish(")", int(active), "");
    }
  }
  return std::nullopt;
}

std::optional<Signature> ofBracket(Snapshot &snapshot, const CursorContext &context) {
  const CursorContext::Bracket &bracket = *context.bracket;
  if (bracket.name.empty())
    return std::nullopt;
  const Dialect &dialect = snapshot.dialect();
  if (bracket.kind == '<') {
    const llvm::StringRef first =
        snapshot.text().slice(bracket.at + 1 + bracket.name.size(), context.offset).ltrim(" \t:");
    const CodeInfo *code = instruction(dialect, bracket.name,
                                       first.take_until([](char c) { return !llvm::isAlnum(c); }));
    if (!code || code->words.empty())
      return std::nullopt;
    return ofArguments(*code, ("<" + bracket.name + ": ").str(), "; ", ">", bracket.argument);
  }
  if (bracket.kind != '(')
    return std::nullopt;
  const CodeIndex index = dialect.keyword(bracket.name);
  if (index == noCode)
    return ofProgram(snapshot, bracket.name, bracket.argument);
  const CodeInfo &code = dialect.codes[index];
  if (code.words.empty())
    return std::nullopt;
  return ofArguments(code, (bracket.name + "(").str(), ", ", ")", bracket.argument);
}

/// The words of a code of the block: `G83 X Y Z R Q F`.
class WordSignature {
public:
  WordSignature(const Dialect &dialect, const CodeInfo &code, const CursorContext &context)
      : dialect_(dialect), code_(code), context_(context), writer_(code.name, " ") {}

  Signature write() {
    const bool macro = code_.action == Action::MacroCall || code_.action == Action::MacroModal;
    AddressMask written = 0;
    for (const bool required : {true, false})
      for (const WordSpec &spec : code_.words)
        if (!spec.position && !spec.variable && spec.role != Role::Argument &&
            (spec.need != Need::Optional) == required) {
          written |= spec.any;
          add(dialect_.alternatives(spec.any), spec.any, specHelp(spec));
        }
    if (macro)
      for (char letter = 'A'; letter <= 'Z'; ++letter)
        if (const uint32_t variable = macroArgument(letter);
            variable && (code_.takes & maskOf(letter)) && !(written & maskOf(letter)))
          add(std::string(1, letter), maskOf(letter),
              "becomes `#" + std::to_string(variable) + "`");
    return writer_.finish("", active_, code_.title);
  }

private:
  void add(const std::string &name, AddressMask mask, std::string documentation) {
    writer_.add(" ", name, std::move(documentation));
    for (const Word &word : context_.block.words)
      if (context_.isTyped(word) && word.address < addressCount && (maskOf(word.address) & mask))
        active_ = count_;
    ++count_;
  }

  const Dialect &dialect_;
  const CodeInfo &code_;
  const CursorContext &context_;
  SignatureWriter writer_;
  int active_ = -1, count_ = 0;
};

} // namespace

std::optional<Signature> signatureHelp(Snapshot &snapshot, uint32_t offset) {
  const CursorContext context = cursorContext(snapshot, offset);
  if (context.inComment)
    return std::nullopt;
  if (context.bracket)
    if (auto signature = ofBracket(snapshot, context))
      return signature;
  const Dialect &dialect = snapshot.dialect();
  const LoneBlock lone(dialect, snapshot.unit().machine, snapshot.unit().executor(), context.block);
  const CodeInfo *last = nullptr;
  for (const CodeUse &use : lone.executed().outcome.codes) {
    const CodeInfo &code = dialect.codes[use.code];
    const bool hasWords = llvm::any_of(
        code.words, [](const WordSpec &spec) { return !spec.position && !spec.variable; });
    if (hasWords && use.word && use.word->offset < context.typedBegin)
      last = &code;
  }
  if (!last)
    return std::nullopt;
  return WordSignature(dialect, *last, context).write();
}

} // namespace ncvet::lsp
