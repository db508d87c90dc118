// Completion of codes and of the words that they read, by the table.
#include "interp/evaluate/condition.h"
#include "interp/state/executed_block.h"
#include "lsp/features/showing/word_help.h"
#include "lsp/features/writing/completion_sources.h"

#include "llvm/ADT/SmallSet.h"
#include "llvm/ADT/StringExtras.h"

namespace ncvet::lsp {

namespace {

/// Ranks of items: what the current code needs comes first.
enum Rank : uint8_t { rankRequired, rankOptional, rankAddress, rankCode };

/// The codes of a block besides the word that is being written.
class BlockCodes {
public:
  explicit BlockCodes(const CompletionRequest &request) : dialect_(request.dialect()) {
    for (const CodeUse &use : request.executed.outcome.codes) {
      if (!use.word || request.context.isTyped(*use.word))
        continue;
      const CodeInfo &code = dialect_.codes[use.code];
      codes_.push_back(&code);
      groups_ |= code.group == noGroup ? 0 : uint64_t(1) << code.group;
      exclusive_ |= code.exclusive;
      cancelsCycle_ |= code.cancelsCycle;
      miscellaneous_ += code.letter == 'M';
    }
    for (const Word &word : request.context.block.words) {
      if (request.context.isTyped(word))
        continue;
      ++words_;
      if (word.address < addressCount)
        written_ |= maskOf(word.address);
    }
    mostMiscellaneous_ = dialect_.limits.mCodesPerBlock;
    if (const auto most = request.snapshot.unit().machine.number("mCodesPerBlock"))
      mostMiscellaneous_ = unsigned(std::max(0.0, *most));
  }

  llvm::ArrayRef<const CodeInfo *> codes() const { return codes_; }
  AddressMask written() const { return written_; }
  bool empty() const { return words_ == 0; }
  bool cancelsCycle() const { return cancelsCycle_; }

  /// Whether the control takes `code` beside what the block holds.
  bool allows(const CodeInfo &code) const {
    if (code.group != noGroup && (groups_ >> code.group & 1) &&
        dialect_.groups[code.group].exclusive)
      return false;
    if ((code.exclusive && exclusive_) || (code.alone && words_ > 0))
      return false;
    return code.letter != 'M' || !mostMiscellaneous_ || miscellaneous_ < mostMiscellaneous_;
  }

private:
  const Dialect &dialect_;
  llvm::SmallVector<const CodeInfo *, 8> codes_;
  uint64_t groups_ = 0; ///< of which the block has a code
  AddressMask written_ = 0;
  unsigned words_ = 0, miscellaneous_ = 0, mostMiscellaneous_ = 0;
  bool exclusive_ = false, cancelsCycle_ = false;
};

/// Whether the program writes `G1` for `G01`: the first code with one digit tells.
bool dropsZeros(llvm::StringRef text) {
  constexpr size_t bytesLookedAt = 8192;
  text = text.take_front(bytesLookedAt);
  for (size_t i = 0; i + 2 < text.size(); ++i) {
    if ((text[i] | 32) != 'g' && (text[i] | 32) != 'm')
      continue;
    if (i > 0 && (llvm::isAlpha(text[i - 1]) || text[i - 1] == '_'))
      continue;
    if (!llvm::isDigit(text[i + 1]))
      continue;
    if (text[i + 1] == '0' && llvm::isDigit(text[i + 2]))
      return false;
    if (!llvm::isDigit(text[i + 2]))
      return true;
  }
  return false;
}

/// The code's name as a program writes it; empty for one that is not written as such.
std::string spelling(const CodeInfo &code, bool short_) {
  llvm::StringRef name = code.name;
  if (name.empty() || code.foreign ||
      !(llvm::isAlpha(name.front()) || (name.front() == '<' && name.back() == '>')))
    return {};
  if (short_ && code.letter && name.size() == 3 && name[1] == '0')
    return name.take_front(1).str() + name.drop_front(2).str();
  return name.str();
}

bool isRequired(const WordSpec &spec) { return spec.need != Need::Optional; }

/// `P`, or `${1|P,X,U|}` where one of several is wanted.
std::string oneOf(const Dialect &dialect, AddressMask any, unsigned number) {
  const std::string words = dialect.alternatives(any); // "P, X or U"
  llvm::SmallVector<llvm::StringRef, 8> names;
  llvm::SplitString(words, names, ", ");
  llvm::erase_value(names, "or");
  if (names.size() == 1)
    return words;
  return "${" + std::to_string(number) + "|" + llvm::join(names, ",") + "|}";
}

/// `CYCLE81(${1:RTP}, …)`, `G83 Z${1:depth} …`; empty: the name alone does.
std::string snippetOf(const Dialect &dialect, const CodeInfo &code, llvm::StringRef name) {
  unsigned most = 0, lastRequired = 0;
  for (const WordSpec &spec : code.words) {
    most = std::max(most, spec.position);
    if (isRequired(spec))
      lastRequired = std::max(lastRequired, spec.position);
  }
  std::string out = snippetText(name);
  unsigned number = 0;
  if (most) {
    if (name.front() == '<')
      return {};
    // A cycle gets all that its table names: later ones may be taken out.
    const unsigned shown = code.action == Action::Cycle ? most : std::max(lastRequired, 1u);
    out += "(";
    for (unsigned position = 1; position <= shown; ++position)
      for (const WordSpec &spec : code.words)
        if (spec.position == position) {
          out += (number ? "," : "") + placeholder(number + 1, spec.name);
          ++number;
          break;
        }
    return out + ")";
  }
  for (const WordSpec &spec : code.words) {
    if (!isRequired(spec) || !spec.any || spec.variable || !spec.when.active.empty())
      continue;
    const std::string address = oneOf(dialect, spec.any, number + 1);
    number += address.front() == '$' ? 2 : 1;
    out += " " + address + placeholder(number, spec.note);
  }
  return number ? out : std::string();
}

/// `<ENT=…>` or `R30=…`, as the grammar writes variables.
std::string assignment(const Dialect &dialect, const std::string &name, std::string value) {
  return dialect.reader == "ecs" ? "<" + name + "=" + value + ">" : name + "=" + value;
}

/// The first of alternatives that no word has yet.
void addSpec(const CompletionRequest &request, const CodeInfo &code, const WordSpec &spec,
             const std::string &prefix) {
  CompletionItem item;
  item.kind = CompletionKind::Parameter;
  item.rank = isRequired(spec) ? rankRequired : rankOptional;
  item.detail = specHelp(spec) + " – " + code.name;
  item.documentation = "code:" + std::to_string(&code - request.dialect().codes.data());
  item.snippet = true;
  if (spec.variable) {
    item.label = assignment(request.dialect(), spec.name, "");
    item.insert = assignment(request.dialect(), snippetText(spec.name), placeholder(1, spec.note));
    return request.add(std::move(item));
  }
  item.label = prefix;
  item.insert = snippetText(prefix) + placeholder(1, spec.note);
  request.add(std::move(item));
}

} // namespace

void completeWords(const CompletionRequest &request) {
  const Dialect &dialect = request.dialect();
  const BlockCodes block(request);
  AddressMask offered = 0;
  llvm::SmallVector<const CodeInfo *, 8> readers(block.codes().begin(), block.codes().end());
  if (const CodeInfo *cycle = request.executed.before.activeCode(dialect, StandardGroup::Cycle);
      cycle && request.executed.before.cycleActive(dialect) == Truth::Yes && !block.cancelsCycle())
    readers.push_back(cycle);
  llvm::SmallSet<uint64_t, 16> variables;
  for (const CodeInfo *code : readers)
    for (const WordSpec &spec : code->words) {
      if (spec.variable && !assignmentOf(request.context.block, spec.variable) &&
          variables.insert(spec.variable).second)
        addSpec(request, *code, spec, "");
      if (spec.position || spec.variable || (spec.any & block.written()))
        continue;
      for (unsigned address = 0; address < variableAddress; ++address)
        if ((spec.any & ~offered) >> address & 1) {
          offered |= maskOf(AddressId(address));
          addSpec(request, *code, spec, dialect.addressName(AddressId(address)));
        }
    }
  for (unsigned address = 0; address < variableAddress; ++address) {
    const AddressInfo &info = dialect.addresses[address];
    const AddressMask mask = maskOf(AddressId(address));
    if (!(mask & dialect.plain) || info.kind == AddressKind::Code ||
        info.kind == AddressKind::Unknown ||
        (mask & (offered | (block.written() & ~dialect.repeatable))))
      continue;
    CompletionItem item;
    item.kind = CompletionKind::Word;
    item.rank = rankAddress;
    item.label = dialect.addressName(AddressId(address));
    item.detail = info.title;
    request.add(std::move(item));
  }
}

void completeCodes(const CompletionRequest &request) {
  const Dialect &dialect = request.dialect();
  const BlockCodes block(request);
  const bool shortNames = dropsZeros(request.snapshot.text());
  const bool lower = !request.typed.empty() && request.typed.front() >= 'a';
  for (size_t i = 0; i < dialect.codes.size(); ++i) {
    const CodeInfo &code = dialect.codes[i];
    if (code.base != CodeIndex(i) && code.base != noCode)
      continue; // a variant
    if (code.action == Action::DefineElement || !block.allows(code))
      continue;
    CompletionItem item;
    item.label = spelling(code, shortNames);
    if (item.label.empty())
      continue;
    if (lower && code.letter)
      item.label = llvm::StringRef(item.label).lower();
    item.kind = CompletionKind::Code;
    item.rank = rankCode;
    item.detail = code.title;
    item.documentation = "code:" + std::to_string(i);
    item.insert = snippetOf(dialect, code, item.label);
    item.snippet = !item.insert.empty();
    request.add(std::move(item));
  }
}

} // namespace ncvet::lsp
