// Arguments of ECS instructions: values, names, strings, targets of jumps.
#include "formats/readers/ecs/ecs_scanner.h"

namespace ncvet {

unsigned EcsScanner::typographicQuote(const char *at, const char *end, bool &comment) {
  if (end - at < 3 || uint8_t(at[0]) != 0xE2 || uint8_t(at[1]) != 0x80)
    return 0;
  const auto third = uint8_t(at[2]);
  comment = third == 0x98 || third == 0x99 || third == 0x9B;
  return third >= 0x98 && third <= 0x9E ? 3 : 0;
}

llvm::StringRef EcsScanner::withoutFolder(llvm::StringRef path) {
  path = path.rtrim();
  const size_t slash = path.find_last_of("\\/");
  return slash == llvm::StringRef::npos ? path : path.drop_front(slash + 1);
}

/// `;` or `,`; 0: neither is next.
char EcsScanner::scanSeparator() {
  skipBlanks();
  if (at_ < end_ && (*at_ == ';' || *at_ == ','))
    return *at_++;
  return 0;
}

void EcsScanner::scanString(Argument &argument) {
  bool comment = false;
  unsigned mark = *at_ == '"' ? 1 : typographicQuote(at_, end_, comment);
  if (mark > 1)
    issue(SyntaxIssueKind::TypographicQuote, at_, at_ + mark);
  const char *const begin = at_;
  at_ += mark;
  argument.kind = ArgumentKind::Text;
  argument.begin = offset(at_);
  for (mark = 0; !atLineEnd(); ++at_) {
    mark = *at_ == '"' ? 1 : typographicQuote(at_, end_, comment);
    if (mark)
      break;
  }
  argument.end = offset(at_);
  if (!mark)
    return issue(SyntaxIssueKind::UnclosedString, begin, at_);
  at_ += mark;
}

/// `N50`, `N<R1>`, `[LABEL]`
Argument EcsScanner::scanTarget(char separator) {
  skipBlanks();
  Argument target;
  target.separator = separator;
  target.begin = target.end = offset(at_);
  if (endsArgument(at_))
    return target;
  if (*at_ == '[') {
    const char *const begin = ++at_;
    while (!atLineEnd() && *at_ != ']' && *at_ != '>')
      ++at_;
    target.kind = ArgumentKind::Label;
    target.begin = offset(begin);
    target.end = offset(at_);
    if (at_ < end_ && *at_ == ']')
      ++at_;
    else
      issue(SyntaxIssueKind::UnbalancedBracket, begin - 1, at_);
    return target;
  }
  if ((*at_ | 32) == 'n') {
    const char *const begin = at_++;
    target.kind = ArgumentKind::BlockNumber;
    if (at_ < end_ && *at_ == '<') {
      target.expression = bracketed();
    } else {
      const char *const digits = at_;
      const auto number = double(takeWhole());
      target.expression = constant(begin, at_, number);
      if (at_ == digits) {
        block_.operations.back().op = Op::Opaque;
        issue(SyntaxIssueKind::BadStatement, begin, at_);
      }
    }
    target.end = offset(at_);
    return target;
  }
  return scanArgument(separator);
}

/// `named`: the name of the argument has been read.
Argument EcsScanner::scanArgument(char separator, bool named) {
  skipBlanks();
  Argument argument;
  argument.separator = separator;
  argument.begin = argument.end = offset(at_);
  bool comment = false;
  if (endsArgument(at_))
    return argument;
  if (*at_ == '"' || typographicQuote(at_, end_, comment)) {
    scanString(argument);
    return argument;
  }
  if (*at_ == '<') {
    argument.kind = ArgumentKind::Expression;
    argument.expression = bracketed();
    argument.end = offset(at_);
    return argument;
  }
  const llvm::StringRef symbol = name();
  const char *const after = afterBlanks(symbol.end());
  const bool ends = endsArgument(after);
  // A symbol: ON, an axis, a name. `R12` is a variable.
  const bool variable = symbol.size() > 1 && (symbol[0] | 32) == 'r' &&
                        llvm::all_of(symbol.drop_front(), isNumberDigit);
  if (!symbol.empty() && isLetter(symbol[0]) && ends && !variable) {
    argument.kind = ArgumentKind::Name;
    at_ = symbol.end();
    argument.end = offset(at_);
    return argument;
  }
  // `ON/X`: the switch is a symbol, what comes after it is no separator.
  if ((symbol.equals_insensitive("ON") || symbol.equals_insensitive("OFF")) && !ends) {
    argument.kind = ArgumentKind::Name;
    at_ = symbol.end();
    argument.end = offset(at_);
    return argument;
  }
  if (!named && !symbol.empty() && isLetter(symbol[0]) && after < end_ && *after == '=') {
    argument.nameBegin = argument.begin; // `AX=X`
    argument.nameEnd = offset(symbol.end());
    at_ = after + 1;
    skipBlanks();
    Argument value = scanArgument(separator, true);
    value.nameBegin = argument.nameBegin;
    value.nameEnd = argument.nameEnd;
    return value;
  }
  const char *const before = at_;
  argument.kind = ArgumentKind::Expression;
  argument.expression = expression();
  argument.end = offset(at_);
  if (at_ == before && !atLineEnd() && *at_ != '>')
    ++at_;
  return argument;
}

/// A name up to the separator.
llvm::StringRef EcsScanner::scanProgramName() {
  skipBlanks();
  const char *const begin = at_;
  while (!endsArgument(at_))
    ++at_;
  return withoutFolder({begin, size_t(at_ - begin)});
}

/// What comes after the last argument is passed over.
void EcsScanner::tooManyArguments(const char *begin) {
  issue(SyntaxIssueKind::TooManyArguments, begin, at_);
  skipToAngle();
}

} // namespace ncvet
