// Calls in Sinumerik blocks: codes and programs with their arguments.
#include "formats/readers/sinumerik/sinumerik_scanner.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {

namespace {
/// Bytes of a double quotation mark as word processors set it, U+201C to U+201E; 0: none.
unsigned typographicQuote(const char *at, const char *end) {
  const llvm::StringRef text(at, size_t(end - at));
  return text.startswith("\xE2\x80\x9C") || text.startswith("\xE2\x80\x9D") ||
                 text.startswith("\xE2\x80\x9E")
             ? 3
             : 0;
}

/// `(CANCEL TRANSFORMATION)`: words and blanks between the brackets, as in another control's
/// remark. After a code that takes nothing, `(CANCEL)` is one as well.
bool looksLikeRemark(const char *at, const char *end, const CodeInfo &code) {
  constexpr ptrdiff_t longWord = 4;
  const char *const begin = at + 1;
  unsigned words = 0;
  bool inWord = false;
  for (++at; at < end && *at != ')'; ++at) {
    if (!llvm::isAlnum(*at) && *at != ' ' && *at != '-')
      return false;
    words += llvm::isAlpha(*at) && !inWord;
    inWord = *at != ' ';
  }
  const bool takesNothing = code.group != noGroup && code.words.empty();
  return at < end &&
         (words > 1 || (takesNothing && at - begin >= longWord &&
                        std::all_of(begin, at, [](char c) { return llvm::isAlpha(c); })));
}
} // namespace

/// What is between two quotes, the first of which is the next byte; none, with an issue, without
/// the second one.
std::optional<llvm::StringRef> SinumerikScanner::scanString() {
  const char *const begin = at_++;
  while (!atLineEnd() && *at_ != '"')
    ++at_;
  if (atLineEnd()) {
    issue(SyntaxIssueKind::UnclosedString, begin, at_);
    return std::nullopt;
  }
  const llvm::StringRef inside(begin + 1, size_t(at_ - begin - 1));
  ++at_;
  return inside;
}

/// A word that is a code by itself, perhaps with arguments.
void SinumerikScanner::scanCode(CodeIndex code, llvm::StringRef name) {
  at_ = name.end();
  Word word;
  word.address = keywordAddress;
  word.mantissa = code;
  addWord(word, name.begin());
  const char *const after = afterBlanks(at_);
  if (after == end_ || *after != '(' ||
      (after > at_ && looksLikeRemark(after, end_, dialect_.codes[code])))
    return;
  at_ = after;
  Item item = itemAt(ItemKind::Instruction, name.begin());
  item.nameBegin = item.begin;
  item.nameEnd = offset(name.end());
  scanArguments(item, /*words=*/true);
  add(item);
}

/// A call of program `name`, which comes before: arguments and passes.
void SinumerikScanner::scanCall(llvm::StringRef name, Item &item) {
  nameItem(item, name);
  const char *after = afterBlanks(at_);
  if (after < end_ && *after == '(') {
    at_ = after;
    scanArguments(item, /*words=*/false);
    after = afterBlanks(at_);
  }
  if (after + 1 < end_ && (*after | 32) == 'p') {
    const char *const value = afterBlanks(after + 1);
    if (value < end_ && (isNumberDigit(*value) || *value == '-' || isEquals(value))) {
      at_ = value + (*value == '=');
      item.count = expression();
    }
  }
  add(item);
}

/// `(a, b,, "c")`
void SinumerikScanner::scanArguments(Item &item, bool words) {
  ++at_; // the parenthesis
  const char *const begin = base_ + item.begin;
  skipBlanks();
  if (at_ < end_ && *at_ == ')') {
    ++at_;
    return;
  }
  for (char separator = 0;; separator = ',') {
    scanArgument(item, separator, words);
    skipBlanks();
    if (at_ < end_ && *at_ == ')') {
      ++at_;
      return;
    }
    if (at_ == end_ || *at_ != ',')
      break;
    ++at_;
  }
  // What follows can be no argument: the list ends here, or the rest of the block is lost.
  const char *p = at_;
  while (p < end_ && !isLineEnd(*p) && *p != ';' && *p != ')')
    ++p;
  if (p < end_ && *p == ')') {
    issue(SyntaxIssueKind::BadExpression, at_, p);
    at_ = p + 1;
    return;
  }
  issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
}

/// A text between quotation marks of a word processor, the first of which has `mark` bytes.
void SinumerikScanner::scanQuoted(Argument &argument, unsigned mark) {
  issue(SyntaxIssueKind::TypographicQuote, at_, at_ + mark);
  at_ += mark;
  argument.kind = ArgumentKind::Text;
  argument.begin = offset(at_);
  while (!atLineEnd() && *at_ != '"' && *at_ != ',' && *at_ != ')' && !typographicQuote(at_, end_))
    ++at_;
  argument.end = offset(at_);
  at_ += atLineEnd() ? 0 : *at_ == '"' ? 1 : typographicQuote(at_, end_);
}

void SinumerikScanner::scanText(Argument &argument) {
  const char *const begin = at_;
  const auto text = scanString();
  if (!text)
    return;
  const char *const next = afterBlanks(at_);
  if (next < end_ && (*next == ',' || *next == ')')) {
    argument.kind = ArgumentKind::Text;
    argument.begin = offset(text->begin());
    argument.end = offset(text->end());
  } else { // a string that is put together
    at_ = begin;
    argument.kind = ArgumentKind::Expression;
    argument.expression = expression();
    argument.end = offset(at_);
  }
}

void SinumerikScanner::scanArgument(Item &item, char separator, bool words) {
  skipBlanks();
  const char *begin = at_;
  Argument argument;
  argument.separator = separator;
  Word word;
  word.address = argumentAddress;
  if (const llvm::StringRef name = identifier(); !name.empty() && !isNumberDigit(name[0])) {
    // A name before the value.
    const char *const after = afterBlanks(name.end());
    if (isEquals(after)) {
      issue(SyntaxIssueKind::NamedArgument, begin, after + 1);
      at_ = after + 1;
      skipBlanks();
      begin = at_;
    }
  }
  argument.begin = argument.end = offset(begin);
  if (at_ == end_ || isLineEnd(*at_) || *at_ == ',' || *at_ == ')' || *at_ == ';') {
    word.flags = wordNoValue;
  } else if (const unsigned mark = typographicQuote(at_, end_)) {
    scanQuoted(argument, mark);
    word.flags = wordExpression;
    word.mantissa = opaque(begin, at_);
  } else if (*at_ == '"') {
    scanText(argument);
    word.flags = wordExpression;
    word.mantissa = opaque(begin, at_);
  } else {
    const char *const after = (isNumberDigit(*at_) || *at_ == '-') && words
                                  ? readPlainNumber<true>(at_, end_, word)
                                  : nullptr;
    const char *const next = after ? afterBlanks(after) : nullptr;
    argument.kind = ArgumentKind::Expression;
    if (next && next < end_ && (*next == ')' || *next == ',')) {
      at_ = after;
      argument.expression = constant(begin, after, word.value());
    } else {
      const size_t issues = block_.issues.size();
      argument.expression = expression();
      word = Word();
      word.address = argumentAddress;
      word.flags = wordExpression;
      word.mantissa = argument.expression;
      if (block_.issues.size() > issues && at_ == begin)
        ++at_;
    }
    argument.end = offset(at_);
  }
  block_.arguments.push_back(argument);
  ++item.arguments;
  if (words)
    addWord(word, begin);
}

/// `MCALL`, `MCALL CYCLE81(..)`, `MCALL HOLE(..)`
void SinumerikScanner::scanModalCall(const char *begin, llvm::StringRef name) {
  scanCode(dialect_.keyword(name), name);
  skipBlanks();
  if (atBlockEnd())
    return;
  const llvm::StringRef called = identifier();
  const char *const after = afterBlanks(called.end());
  const bool isProgram = called.size() > 1 && codeNamed(called) == noCode &&
                         sinumerikKeyword(called) == Keyword::None && !isEquals(after) &&
                         (isNameLetter(called[1]) || (called[0] | 32) == 'l');
  if (!isProgram)
    return;
  Item item = itemAt(ItemKind::Call, begin);
  item.modal = true;
  at_ = called.end();
  scanCall(called, item);
}

/// `CALL BLOCK BEGIN1 TO END1`: the section between two labels of this program once more.
void SinumerikScanner::scanSection(Item item) {
  const auto label = [&](char separator) {
    skipBlanks();
    const llvm::StringRef name = identifier();
    if (name.empty() || isNumberDigit(name[0]))
      return false;
    Argument argument;
    argument.kind = ArgumentKind::Label;
    argument.separator = separator;
    argument.begin = offset(name.begin());
    argument.end = offset(name.end());
    block_.arguments.push_back(argument);
    ++item.arguments;
    at_ = name.end();
    skipBlanks();
    return true;
  };
  const char *const begin = at_;
  item.firstArgument = uint16_t(block_.arguments.size());
  bool good = label(0) && identifier().equals_insensitive("TO");
  if (good)
    at_ = identifier().end();
  good = good && label(' ') && atBlockEnd();
  if (good) {
    item.kind = ItemKind::Repeat;
    item.jump = JumpKind::Anywhere;
    item.count = constant(begin, begin, 1);
  } else { // names of labels that only the run puts together
    block_.arguments.truncate(item.firstArgument);
    item.arguments = 0;
    item.external = true;
    item.value = opaque(begin, at_);
    rest();
  }
  add(item);
}

/// `CALL "NAME"`, `CALL VARIABLE`, `PCALL /_N_SPF_DIR/NAME(..)`, `EXTCALL("NAME")`
void SinumerikScanner::scanIndirectCall(Keyword keyword, const char *begin) {
  Item item = itemAt(ItemKind::Call, begin);
  item.external = keyword == Keyword::ExternalCall;
  skipBlanks();
  const bool bracket = at_ < end_ && *at_ == '(';
  const char *const open = bracket ? afterBlanks(at_ + 1) : at_;
  if (open < end_ && *open == '"') {
    at_ = open;
    const auto name = scanString();
    if (!name)
      return;
    skipBlanks();
    if (bracket && at_ < end_ && *at_ == ')')
      ++at_;
    if (!identifier().equals_insensitive("BLOCK"))
      return scanCall(*name, item);
    item.external = true;
    rest();
    return scanCall(*name, item);
  }
  if (keyword == Keyword::PathCall) {
    const char *p = at_;
    while (p < end_ && !isSinumerikBlank(*p) && !isLineEnd(*p) && *p != '(' && *p != ';')
      ++p;
    const llvm::StringRef path(at_, size_t(p - at_));
    at_ = p;
    return scanCall(path, item);
  }
  if (identifier().equals_insensitive("BLOCK")) {
    at_ = identifier().end();
    return scanSection(item);
  }
  item.external |= bracket;
  item.value = expression();
  rest();
  add(item);
}

} // namespace ncvet
