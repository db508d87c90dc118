// Completion: finds out by the text before the cursor what may follow.
#include "lsp/features/writing/completion.h"

#include "interp/evaluate/condition.h"
#include "lsp/features/showing/word_help.h"
#include "lsp/features/writing/completion_sources.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet::lsp {

namespace {

/// An editor filters what it shows; more than this helps nobody.
constexpr size_t mostItems = 3000;

bool isJumpWord(llvm::StringRef name) {
  return name.startswith_insensitive("GOTO") || name.equals_insensitive("REPEAT") ||
         name.equals_insensitive("REPEATB") || name.equals_insensitive("JMP") ||
         name.equals_insensitive("RPT") || name.equals_insensitive("IFF");
}

llvm::StringRef lastName(llvm::StringRef text) {
  size_t begin = text.size();
  while (begin > 0 && (llvm::isAlnum(text[begin - 1]) || text[begin - 1] == '_'))
    --begin;
  return text.drop_front(begin);
}

/// What is expected at the cursor.
class Dispatch {
public:
  Dispatch(Snapshot &snapshot, const CursorContext &context, const ExecutedBlock &executed,
           std::vector<CompletionItem> &items)
      : snapshot_(snapshot), context_(context), executed_(executed), items_(items) {}

  void run() const {
    const llvm::StringRef before = context_.before, typed = context_.typed;
    const char last = before.empty() ? '\0' : before.back();
    const llvm::StringRef text = snapshot_.text();
    const bool glued = context_.typedBegin > 0 && !before.empty() &&
                       before.end() == text.data() + context_.typedBegin;
    if (const auto digits = jumpDigits())
      return completeTargets(request(context_.offset - *digits));
    if (wantsTarget(before))
      return completeTargets(request(context_.typedBegin));
    if (glued && last == '#')
      return completeVariables(request(context_.typedBegin - 1));
    if (glued && last == '<' && before.endswith("#<"))
      return completeVariables(request(context_.typedBegin - 2));
    if (namedWord())
      return;
    if (context_.bracket && context_.bracket->kind == '<')
      return inAngle(glued && last == '<');
    if (context_.bracket || llvm::StringRef("=+-*/").contains(last ? last : ' '))
      return completeVariables(request(context_.typedBegin));
    if (!typed.empty() && llvm::isDigit(typed.front()))
      return; // a number
    const CompletionRequest here = request(context_.typedBegin);
    completeWords(here);
    completeCodes(here);
    completeStatements(here);
    completePrograms(here, /*byNumber=*/false);
  }

private:
  CompletionRequest request(uint32_t begin) const {
    return {snapshot_,
            context_,
            executed_,
            {snapshot_.source().id(), begin, context_.offset},
            snapshot_.text().slice(begin, context_.offset),
            items_};
  }

  /// `GOTO10`: how many digits follow the word.
  std::optional<uint32_t> jumpDigits() const {
    const llvm::StringRef typed = context_.typed;
    const llvm::StringRef letters =
        typed.take_while([](char c) { return llvm::isAlpha(c) || c == '_'; });
    const llvm::StringRef digits = typed.drop_front(letters.size());
    if (!letters.equals_insensitive("GOTO") || !llvm::all_of(digits, llvm::isDigit) ||
        (digits.empty() && snapshot_.dialect().lexical.commaSeparates))
      return std::nullopt;
    return uint32_t(digits.size());
  }

  bool wantsTarget(llvm::StringRef before) const {
    const bool list = before.endswith(":") || before.endswith(";");
    if (list && context_.bracket)
      return isJumpWord(context_.bracket->name.take_while(llvm::isAlpha));
    return !list && isJumpWord(lastName(before));
  }

  /// `P100` of a call or of a profile: programs and blocks.
  bool namedWord() const {
    for (const Word &word : context_.block.words) {
      if (!context_.isTyped(word) || word.address >= firstNamed)
        continue;
      const WordUse use = useOf(executed_, word);
      const uint32_t value = word.offset + 1;
      if (!use.spec || value > context_.offset)
        continue;
      switch (use.spec->role) {
      case Role::ProfileFirst:
      case Role::ProfileLast:
      case Role::Sequence:
        completeTargets(request(value));
        return true;
      case Role::Program:
        completePrograms(request(value), /*byNumber=*/true);
        return true;
      default:
        break;
      }
    }
    return false;
  }

  /// After `<`: instructions and the variables that cycles read; in one: what it takes.
  void inAngle(bool atBegin) const {
    if (!atBegin)
      return completeVariables(request(context_.typedBegin));
    const CompletionRequest here = request(context_.bracket->at);
    completeWords(here);
    completeCodes(here);
    completeStatements(here);
  }

  Snapshot &snapshot_;
  const CursorContext &context_;
  const ExecutedBlock &executed_;
  std::vector<CompletionItem> &items_;
};

} // namespace

void CompletionRequest::add(CompletionItem item) const {
  if (items.size() >= mostItems || !llvm::StringRef(item.label).startswith_insensitive(typed))
    return;
  item.replace = replace;
  if (item.insert.empty())
    item.insert = item.label;
  items.push_back(std::move(item));
}

std::vector<CompletionItem> completions(Snapshot &snapshot, uint32_t offset,
                                        const MachineState *before) {
  std::vector<CompletionItem> items;
  const CursorContext context = cursorContext(snapshot, offset);
  if (context.inComment || context.inString)
    return items;
  const LoneBlock lone(snapshot.dialect(), snapshot.unit().machine, snapshot.unit().executor(),
                       context.block, before);
  CursorContext written = context;
  written.block = lone.block();
  Dispatch(snapshot, written, lone.executed(), items).run();
  llvm::stable_sort(
      items, [](const CompletionItem &a, const CompletionItem &b) { return a.rank < b.rank; });
  return items;
}

std::string completionHelp(const Dialect &dialect, llvm::StringRef id) {
  unsigned index = 0;
  if (!id.consume_front("code:") || id.getAsInteger(10, index) || index >= dialect.codes.size())
    return {};
  return codeHelp(dialect, dialect.codes[index]);
}

std::string snippetText(llvm::StringRef text) {
  std::string out;
  for (const char c : text) {
    if (c == '$' || c == '}' || c == '\\')
      out += '\\';
    out += c;
  }
  return out;
}

std::string placeholder(unsigned number, llvm::StringRef text) {
  return "${" + std::to_string(number) + ":" + snippetText(text) + "}";
}

} // namespace ncvet::lsp
