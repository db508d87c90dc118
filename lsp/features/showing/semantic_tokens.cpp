// Semantic tokens: places whose meaning the block tells, and between them what the spelling tells.
#include "lsp/features/showing/semantic_tokens.h"

#include "interp/evaluate/condition.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"

#include <algorithm>

namespace ncvet::lsp {

llvm::ArrayRef<llvm::StringLiteral> tokenTypeNames() {
  static constexpr llvm::StringLiteral names[] = {
      "function", "macro", "keyword",    "property", "parameter", "number", "variable", "method",
      "class",    "label", "enumMember", "type",     "operator",  "string", "comment"};
  static_assert(std::size(names) == size_t(TokenType::Count));
  return names;
}

llvm::ArrayRef<llvm::StringLiteral> tokenModifierNames() {
  static constexpr llvm::StringLiteral names[] = {"definition", "deprecated"};
  return names;
}

namespace {

bool isNameStart(char c) { return llvm::isAlpha(c) || c == '_' || c == '$'; }
bool isNameRest(char c) { return llvm::isAlnum(c) || c == '_'; }

bool isTypeName(llvm::StringRef name) {
  return llvm::StringSwitch<bool>(name.upper())
      .Cases("INT", "REAL", "BOOL", "CHAR", "STRING", "AXIS", "FRAME", true)
      .Default(false);
}

/// What an operation that is spelled with letters is; Number for one that is not.
TokenType typeOf(Op op) {
  switch (op) {
  case Op::Variable:
  case Op::VariableAt:
  case Op::ElementAt:
  case Op::ElementKey:
    return TokenType::Variable;
  case Op::Number:
  case Op::Vacant:
  case Op::Opaque:
  case Op::Unknown:
    return TokenType::Number;
  case Op::Modulo:
  case Op::Equal:
  case Op::NotEqual:
  case Op::Greater:
  case Op::GreaterEqual:
  case Op::Less:
  case Op::LessEqual:
  case Op::And:
  case Op::Or:
  case Op::Xor:
  case Op::Not:
  case Op::IntegerDivide:
  case Op::FloorModulo:
    return TokenType::Operator;
  default:
    return TokenType::Function;
  }
}

/// Makes the tokens of one block after the other.
class Painter {
public:
  Painter(const Snapshot &snapshot, std::vector<SemanticToken> &tokens)
      : text_(snapshot.text()), dialect_(snapshot.dialect()), tokens_(tokens) {}

  void paint(const Block &block) {
    block_ = &block;
    places_.clear();
    regions_.clear();
    collect();
    llvm::stable_sort(places_, [](const SemanticToken &a, const SemanticToken &b) {
      return a.begin < b.begin || (a.begin == b.begin && a.end < b.end);
    });
    llvm::stable_sort(regions_, [](const Region &a, const Region &b) {
      return a.begin < b.begin || (a.begin == b.begin && a.end > b.end);
    });
    open_.clear();
    nextRegion_ = 0;
    issues_.assign(block.issues.begin(), block.issues.end());
    llvm::sort(issues_,
               [](const SyntaxIssue &a, const SyntaxIssue &b) { return a.begin < b.begin; });
    nextIssue_ = badUntil_ = 0;
    const uint32_t end = std::max(block.end, block.next);
    uint32_t at = block.begin;
    for (const SemanticToken &place : places_) {
      if (place.begin < at)
        continue;
      scan(at, place.begin);
      emit(place.begin, place.end, place.type, place.modifiers);
      at = std::max(at, place.end);
    }
    scan(at, std::min<uint32_t>(end, uint32_t(text_.size())));
  }

private:
  /// Part of a block in which names mean something.
  struct Region {
    uint32_t begin, end;
    TokenType names; ///< of names in it that nothing else is known of
  };

  llvm::StringRef at(uint32_t begin, uint32_t end) const { return text_.slice(begin, end); }
  void place(uint32_t begin, uint32_t end, TokenType type, uint8_t modifiers = 0) {
    if (begin < end)
      places_.push_back({begin, end, type, modifiers});
  }

  void collect() {
    const Block &block = *block_;
    for (const Comment &comment : block.comments)
      place(comment.begin, comment.end, TokenType::Comment);
    place(block.headerBegin, block.headerEnd, TokenType::Program, tokenDefinition);
    place(block.numberBegin, block.numberEnd, TokenType::Label, tokenDefinition);
    place(block.labelBegin, block.labelEnd, TokenType::Label, tokenDefinition);
    if (block.kind == BlockKind::Tape)
      place(block.begin, block.end, TokenType::Keyword);
    collectRoles();
    for (const Item &item : block.items)
      collect(item);
    for (const Word &word : block.words)
      collect(word);
    for (const Expression &expression : block.expressions)
      regions_.push_back({expression.begin, expression.end, TokenType::Variable});
    for (const ExpressionOp &op : block.operations)
      collect(op);
  }

  /// Which words of the block name blocks and programs, by the formats of its codes.
  void collectRoles() {
    sequences_ = programs_ = 0;
    for (const Word &word : block_->words) {
      const CodeIndex code = codeOf(dialect_, word);
      if (code == noCode)
        continue;
      for (const WordSpec &spec : dialect_.codes[code].words) {
        if (spec.role == Role::ProfileFirst || spec.role == Role::ProfileLast ||
            spec.role == Role::Sequence)
          sequences_ |= spec.any;
        else if (spec.role == Role::Program)
          programs_ |= spec.any;
      }
    }
  }

  void collect(const Word &word) {
    const uint32_t begin = word.offset, end = block_->endOf(word);
    if (word.address == variableAddress || word.address == argumentAddress ||
        word.address == noAddress)
      return;
    if (word.address == keywordAddress)
      return collectKeyword(word, end);
    const AddressInfo &address = dialect_.addresses[word.address];
    if (address.kind == AddressKind::Code) {
      const TokenType type =
          word.address == letterAddress('M') ? TokenType::Miscellaneous : TokenType::Code;
      if (!word.isNumber())
        return place(begin, begin + 1, type);
      return place(begin, end, type, codeOf(dialect_, word) == noCode ? tokenUnknown : 0);
    }
    const bool moves = address.kind == AddressKind::Axis ||
                       address.kind == AddressKind::Increment || address.kind == AddressKind::Polar;
    const uint32_t value = endOfAddress(begin, end);
    place(begin, value, moves ? TokenType::Axis : TokenType::Parameter,
          address.kind == AddressKind::Unknown ? tokenUnknown : 0);
    if (!word.isNumber())
      return;
    uint32_t number = value;
    while (number < end && !llvm::isDigit(text_[number]) && text_[number] != '.' &&
           text_[number] != '-' && text_[number] != '+')
      ++number;
    const AddressMask mask = maskOf(word.address);
    place(number, end,
          mask & sequences_                      ? TokenType::Label
          : mask & programs_                     ? TokenType::Program
          : address.kind == AddressKind::Element ? TokenType::Label
                                                 : TokenType::Number);
  }

  /// End of the letters (and comma) with which a word begins; of `X1=` the digit belongs to them.
  uint32_t endOfAddress(uint32_t begin, uint32_t end) const {
    uint32_t p = begin;
    while (p < end && (llvm::isAlpha(text_[p]) || text_[p] == ',' || text_[p] == '_'))
      ++p;
    uint32_t digits = p;
    while (digits < end && llvm::isDigit(text_[digits]))
      ++digits;
    if (digits > p && digits < end && text_[digits] == '=')
      p = digits;
    return std::max(p, begin + 1);
  }

  /// A code that is a word: its name, not what is in brackets with it.
  void collectKeyword(const Word &word, uint32_t end) {
    uint32_t p = word.offset;
    while (p < end && !isNameStart(text_[p]))
      ++p;
    const uint32_t begin = p;
    while (p < end && (isNameRest(text_[p]) || text_[p] == '$' || text_[p] == '.'))
      ++p;
    const auto code = size_t(word.mantissa);
    const bool macro = code < dialect_.codes.size() &&
                       (dialect_.codes[code].letter == 'M' ||
                        (p - begin > 1 && text_[begin] == 'M' && llvm::isDigit(text_[begin + 1])));
    place(begin, p, macro ? TokenType::Miscellaneous : TokenType::Code);
  }

  void collect(const Item &item) {
    const bool instruction = item.kind == ItemKind::Instruction;
    regions_.push_back(
        {item.begin, item.end, instruction ? TokenType::Symbol : TokenType::Keyword});
    switch (item.kind) {
    case ItemKind::Call: {
      // `o<name> call`: the mark and the brackets belong to the name.
      const bool marked = item.nameBegin == item.begin + 2 && item.nameEnd < text_.size() &&
                          text_[item.nameEnd] == '>' && llvm::isAlpha(text_[item.begin]);
      place(marked ? item.begin : item.nameBegin, item.nameEnd + marked, TokenType::Program);
      break;
    }
    case ItemKind::Macro:
    case ItemKind::Parameters:
    case ItemKind::Declaration:
      place(item.nameBegin, item.nameEnd, TokenType::Program, tokenDefinition);
      break;
    case ItemKind::Definition:
      place(item.nameBegin, item.nameEnd, TokenType::Variable, tokenDefinition);
      break;
    case ItemKind::Instruction:
      place(item.nameBegin, item.nameEnd, TokenType::Code);
      break;
    case ItemKind::Structure:
      collectStructure(item);
      break;
    case ItemKind::Jump:
      if (item.value != noExpression && block_->expressions[item.value].count == 1)
        placeNumber(block_->expressions[item.value], TokenType::Label);
      break;
    default:
      break;
    }
    for (const Argument &argument : block_->argumentsOf(item))
      collect(argument, item.kind);
  }

  void collectStructure(const Item &item) {
    if (item.structure == Structure::For)
      return place(item.nameBegin, item.nameEnd, TokenType::Variable);
    if (!item.label)
      return;
    uint32_t p = item.begin; // `o100`, `o<name>`
    while (p < item.end && !llvm::isSpace(text_[p]))
      ++p;
    const bool program = item.structure == Structure::Sub;
    place(item.begin, p, program ? TokenType::Program : TokenType::Label,
          program ? tokenDefinition : 0);
  }

  void placeNumber(const Expression &expression, TokenType type) {
    if (block_->operations[expression.first].op == Op::Number)
      place(expression.begin, expression.end, type);
  }

  void collect(const Argument &argument, ItemKind of) {
    place(argument.nameBegin, argument.nameEnd, TokenType::Parameter);
    switch (argument.kind) {
    case ArgumentKind::Text: // with its quotes
      if (argument.begin && argument.end < text_.size() && text_[argument.begin - 1] == '"')
        place(argument.begin - 1, argument.end + (text_[argument.end] == '"'), TokenType::String);
      break;
    case ArgumentKind::Name:
      if (of == ItemKind::Parameters || of == ItemKind::Declaration)
        place(argument.begin, argument.end, TokenType::Variable, tokenDefinition);
      else
        place(argument.begin, argument.end, TokenType::Symbol);
      break;
    case ArgumentKind::BlockNumber:
    case ArgumentKind::Label:
      place(argument.begin, argument.end, TokenType::Label);
      break;
    case ArgumentKind::Empty:
    case ArgumentKind::Expression:
      break;
    }
  }

  /// An operand or operator that is spelled with letters, or a numbered variable.
  void collect(const ExpressionOp &op) {
    const uint32_t begin = op.offset;
    if (begin < block_->begin || begin >= text_.size())
      return;
    const TokenType type = typeOf(op.op);
    if (type == TokenType::Number || !isNameStart(text_[begin]))
      return;
    uint32_t p = begin;
    while (p < text_.size() &&
           (type == TokenType::Operator ? llvm::isAlpha(text_[p]) || text_[p] == '_'
                                        : isNameRest(text_[p]) || text_[p] == '$'))
      ++p;
    place(begin, p, type);
  }

  void emit(uint32_t begin, uint32_t end, TokenType type, uint8_t modifiers = 0) {
    constexpr llvm::StringLiteral lineEnds = "\r\n";
    while (begin < end) {
      // Only as far as the token: a line may be as long as the file.
      const size_t line = at(begin, end).find_first_of(lineEnds);
      const uint32_t stop = line == llvm::StringRef::npos ? end : begin + uint32_t(line);
      if (stop > begin)
        tokens_.push_back({begin, stop, type, modifiers});
      begin = stop + 1;
    }
  }

  /// Text of which no place says what it is: by its spelling.
  void scan(uint32_t from, uint32_t to) {
    for (uint32_t p = from; p < to;) {
      const char c = text_[p];
      const uint32_t begin = p++;
      if (llvm::isDigit(c) || beginsNumber(begin, to)) {
        while (p < to && (llvm::isDigit(text_[p]) || text_[p] == '.'))
          ++p;
        emit(begin, p, TokenType::Number);
      } else if (isNameStart(c)) {
        while (p < to && isNameRest(text_[p]))
          ++p;
        emitName(begin, p);
      } else if (c == '#') {
        p = endOfVariable(begin, to);
        emit(begin, p, TokenType::Variable);
      } else if (c == '"') {
        while (p < to && text_[p] != '"' && text_[p] != '\n' && text_[p] != '\r')
          ++p;
        p += p < to && text_[p] == '"';
        emit(begin, p, TokenType::String);
      } else if (llvm::StringRef("+-*/=<>&%").contains(c)) {
        while (p < to && llvm::StringRef("*=<>").contains(text_[p]))
          ++p;
        emit(begin, p, TokenType::Operator);
      }
    }
  }

  /// A point, or a sign that is no operator, before a digit.
  bool beginsNumber(uint32_t at, uint32_t to) const {
    uint32_t p = at;
    if (text_[p] == '-' || text_[p] == '+') {
      const size_t before = text_.take_front(p).find_last_not_of(" \t");
      if (before != llvm::StringRef::npos && before >= block_->begin &&
          !llvm::StringRef("(,=[:;<").contains(text_[before]))
        return false;
      ++p;
    }
    p += p < to && text_[p] == '.';
    return p > at && p < to && llvm::isDigit(text_[p]);
  }

  /// `#100`, `#<name>`; of `#[..]` and `##1` only the first character.
  uint32_t endOfVariable(uint32_t begin, uint32_t to) const {
    uint32_t p = begin + 1;
    if (p < to && text_[p] == '<') {
      const size_t close = text_.slice(p, to).find_first_of(">\r\n");
      return close == llvm::StringRef::npos ? p : p + uint32_t(close) + (text_[p + close] == '>');
    }
    while (p < to && llvm::isDigit(text_[p]))
      ++p;
    return p;
  }

  /// A name that is no operand: a keyword of its statement.
  void emitName(uint32_t begin, uint32_t end) {
    while (nextIssue_ < issues_.size() && issues_[nextIssue_].begin <= begin)
      badUntil_ = std::max(badUntil_, issues_[nextIssue_++].end);
    if (begin < badUntil_)
      return; // nobody knows what it is
    TokenType type = namesAt(begin);
    if (type == TokenType::Keyword && isTypeName(at(begin, end)))
      type = TokenType::Type;
    if (type == TokenType::Keyword) { // `GOTO10`: the number is not part of it
      uint32_t letters = begin;
      while (letters < end && !llvm::isDigit(text_[letters]))
        ++letters;
      emit(begin, letters, type);
      return emit(letters, end, TokenType::Number);
    }
    emit(begin, end, type);
  }

  /// What names are in the innermost region that holds `begin`. Places are asked for in order.
  TokenType namesAt(uint32_t begin) {
    for (; nextRegion_ < regions_.size() && regions_[nextRegion_].begin <= begin; ++nextRegion_)
      open_.push_back(regions_[nextRegion_]);
    while (!open_.empty() && open_.back().end <= begin)
      open_.pop_back();
    return open_.empty() ? TokenType::Keyword : open_.back().names;
  }

  const llvm::StringRef text_;
  const Dialect &dialect_;
  std::vector<SemanticToken> &tokens_;
  const Block *block_ = nullptr;
  std::vector<SemanticToken> places_;
  std::vector<Region> regions_, open_;
  size_t nextRegion_ = 0, nextIssue_ = 0;
  std::vector<SyntaxIssue> issues_; ///< by where they begin
  uint32_t badUntil_ = 0;           ///< end of those that begin before the current place
  AddressMask sequences_ = 0, programs_ = 0;
};

} // namespace

std::vector<SemanticToken> semanticTokens(Snapshot &snapshot, uint32_t begin, uint32_t end) {
  std::vector<SemanticToken> tokens;
  const llvm::ArrayRef<uint32_t> blocks = snapshot.blocks();
  auto at = std::upper_bound(blocks.begin(), blocks.end(), begin);
  if (at != blocks.begin())
    --at;
  Painter painter(snapshot, tokens);
  Block block;
  for (; at != blocks.end() && *at < end; ++at) {
    snapshot.unit().reader->read(*at, block);
    painter.paint(block);
  }
  llvm::erase_if(
      tokens, [&](const SemanticToken &token) { return token.end <= begin || token.begin >= end; });
  return tokens;
}

} // namespace ncvet::lsp
