// O-words of RS274/NGC: `o100 sub`, `o<name> call [1] [2]`, `o101 if [#1 GT 2]`.
#include "formats/readers/iso/iso_scanner.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"
#include "llvm/Support/xxhash.h"

namespace ncvet {

namespace {

/// The bracket that a keyword is; a call is none.
std::optional<Structure> structureNamed(llvm::StringRef keyword) {
  return llvm::StringSwitch<std::optional<Structure>>(keyword)
      .CaseLower("sub", Structure::Sub)
      .CaseLower("endsub", Structure::EndSub)
      .CaseLower("return", Structure::Return)
      .CaseLower("if", Structure::If)
      .CaseLower("elseif", Structure::ElseIf)
      .CaseLower("else", Structure::Else)
      .CaseLower("endif", Structure::EndIf)
      .CaseLower("while", Structure::While)
      .CaseLower("endwhile", Structure::EndWhile)
      .CaseLower("do", Structure::Repeat)
      .CaseLower("repeat", Structure::Times)
      .CaseLower("endrepeat", Structure::EndTimes)
      .CaseLower("break", Structure::Break)
      .CaseLower("continue", Structure::Continue)
      .Default(std::nullopt);
}

} // namespace

std::string isoFlowLabel(llvm::StringRef label) {
  std::string key;
  for (const char c : label)
    if (c != ' ' && c != '\t')
      key += llvm::toUpper(c);
  // `O002` is `O2`.
  const size_t digit = key.find_first_not_of('0');
  if (digit != std::string::npos && llvm::all_of(key, llvm::isDigit))
    key.erase(0, digit);
  return key;
}

/// An O-word; without a keyword it is the header of a numbered program.
void IsoScanner::scanFlowWord() {
  const char *const begin = at_++;
  skipBlanks();
  Item item = itemAt(ItemKind::Structure, begin);
  const char *const label = at_;
  std::optional<llvm::StringRef> name = scanFlowName(item);
  if (!name)
    return;
  const llvm::StringRef computed(label, size_t(at_ - label));
  skipBlanks();
  const llvm::SmallString<12> keyword = takeFlowKeyword();
  if (keyword.empty() && !name->empty())
    return numberedHeader(begin, *name);
  const bool call = keyword.equals_insensitive("call");
  const std::optional<Structure> structure = structureNamed(keyword);
  if (!call && !structure)
    return issue(SyntaxIssueKind::BadStatement, begin, at_);
  if (!call && name->empty()) { // a bracket by an expression: both ends are written alike
    name = computed;
    item.value = noExpression;
  }
  item.label = uint32_t(llvm::xxHash64(isoFlowLabel(*name))) | 1;
  nameItem(item, *name);
  if (call) {
    item.kind = ItemKind::Call;
    item.positional = true;
    scanCallArguments(item);
  } else {
    item.structure = *structure;
    scanFlowValue(item);
  }
  add(item);
  scanAfterFlowWord();
}

/// The number or name after `O`; empty when an expression, the value of `item`, gives it. None,
/// with an issue, when there is none.
std::optional<llvm::StringRef> IsoScanner::scanFlowName(Item &item) {
  const char *const begin = base_ + item.begin;
  const char *name = at_;
  if (at_ < end_ && isNumberDigit(*at_)) {
    while (at_ < end_ && isNumberDigit(*at_))
      ++at_;
    return llvm::StringRef(name, size_t(at_ - name));
  }
  if (at_ < end_ && *at_ == '<') {
    name = ++at_;
    while (!atLineEnd() && *at_ != '>')
      ++at_;
    if (atLineEnd()) {
      issue(SyntaxIssueKind::BadStatement, begin, at_);
      return std::nullopt;
    }
    return llvm::StringRef(name, size_t(at_++ - name));
  }
  if (at_ < end_ && (*at_ == '[' || *at_ == '#')) {
    item.value = operand();
    return llvm::StringRef(name, 0);
  }
  at_ = begin + 1;
  issue(SyntaxIssueKind::MissingValue, begin, at_);
  return std::nullopt;
}

/// Its letters. Blanks do not count: `else if` is `elseif`.
llvm::SmallString<12> IsoScanner::takeFlowKeyword() {
  llvm::SmallString<12> letters;
  for (const char *p = at_; p < end_ && (isLetter(*p) || isLineBlank(*p)); ++p)
    if (isLetter(*p)) {
      letters += *p;
      at_ = p + 1;
    }
  return letters;
}

/// `O100` alone.
void IsoScanner::numberedHeader(const char *begin, llvm::StringRef name) {
  block_.kind = BlockKind::ProgramHeader;
  block_.headerBegin = offset(begin);
  block_.headerEnd = offset(at_);
  int64_t number = -1;
  block_.program = name.getAsInteger(10, number) ? -1 : number;
  if (!isNumberDigit(name.front())) {
    block_.nameBegin = offset(name.begin());
    block_.nameEnd = offset(name.end());
  }
}

/// What is after the keyword of a bracket: its condition, how often it runs, what it returns.
void IsoScanner::scanFlowValue(Item &item) {
  const char *const begin = base_ + item.begin;
  switch (item.structure) {
  case Structure::If:
  case Structure::ElseIf:
  case Structure::While:
    item.condition = bracketIfAny(); // what else is here is an issue of its own
    if (item.condition == noExpression && (atLineEnd() || *at_ == '(' || *at_ == ';'))
      issue(SyntaxIssueKind::BadStatement, begin, at_);
    break;
  case Structure::Times:
    item.target = constant(begin, at_, double(elementKey(variableKey("repeat "), item.begin)));
    item.value = operand();
    break;
  case Structure::Sub:
    block_.labelBegin = item.nameBegin;
    block_.labelEnd = item.nameEnd;
    break;
  case Structure::EndSub:
  case Structure::Return:
    item.value = bracketIfAny();
    break;
  default:
    break;
  }
}

/// The expression in brackets that is here; `noExpression` when there is none.
uint16_t IsoScanner::bracketIfAny() {
  skipBlanks();
  return at_ < end_ && *at_ == '[' ? operand() : noExpression;
}

/// Comments may be between the arguments.
void IsoScanner::scanCallArguments(Item &item) {
  const auto next = [this] {
    for (skipBlanks(); at_ < end_ && *at_ == '('; skipBlanks())
      scanComment();
    return bracketIfAny();
  };
  for (uint16_t value = next(); value != noExpression; value = next()) {
    Argument argument;
    argument.kind = ArgumentKind::Expression;
    argument.expression = value;
    argument.begin = block_.expressions[value].begin;
    argument.end = block_.expressions[value].end;
    block_.arguments.push_back(argument);
    ++item.arguments;
  }
  constexpr unsigned mostArguments = 30; // LinuxCNC 2.9, section 11.7.4: #1 to #30
  if (item.arguments > mostArguments)
    issue(SyntaxIssueKind::TooManyArguments, base_ + item.begin, at_);
}

/// `IF [#1 GT 2] GOTO 10`, where conditions are O-words: one issue for all of the line. False, with
/// nothing read: there is none.
bool IsoScanner::scanForeignIf() {
  const char *const begin = at_;
  constexpr size_t letters = 2;
  if (!isKeyword("IF") || !startsBlock())
    return false;
  if (const char *const next = afterBlanks(at_ + letters); next >= end_ || *next != '[')
    return false;
  at_ = lineEnd();
  issue(SyntaxIssueKind::BadStatement, begin, at_);
  return true;
}

/// Nothing but a comment may be beside an O-word.
void IsoScanner::scanAfterFlowWord() {
  skipBlanks();
  const char *const rest = at_;
  while (!atLineEnd() && *at_ != '(' && *at_ != ';')
    ++at_;
  if (at_ > rest)
    issue(SyntaxIssueKind::BadStatement, rest, at_);
}

} // namespace ncvet
