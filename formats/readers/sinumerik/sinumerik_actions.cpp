// Synchronised actions in Sinumerik blocks: what the control does beside the program.
#include "formats/readers/sinumerik/sinumerik_scanner.h"

#include "llvm/ADT/STLExtras.h"

namespace ncvet {

namespace {

/// `$R12`, `$R[12]`: the R parameter as it is while the machine moves.
bool isMovingParameter(llvm::StringRef text) {
  return text.size() > 2 && text.startswith_insensitive("$R") &&
         (text[2] == '[' || isNumberDigit(text[2]));
}

} // namespace

/// A name that is a code of the table, which ends here.
void SinumerikScanner::addKeyword(llvm::StringRef name) {
  const CodeIndex code = dialect_.keyword(name);
  if (code == noCode)
    return;
  Word word;
  word.address = keywordAddress;
  word.mantissa = code;
  word.offset = offset(name.begin());
  word.length = uint8_t(name.size());
  append(word);
}

/// `ID=1 WHENEVER $A_IN[1]==1 DO M8 ELSE M9`, `WHEN $AA_IW[Z]>5 DO DELDTG`, `DO $A_OUT[1]=1`: the
/// rest of the block. When it acts is not known; the program goes on at once.
void SinumerikScanner::scanSynchronised(Keyword keyword, const char *begin) {
  Item item = itemAt(ItemKind::Output, begin);
  llvm::StringRef name(begin, size_t(at_ - begin));
  const size_t issues = block_.issues.size();
  const char *end = at_;
  if (keyword == Keyword::Identity) {
    addKeyword(name);
    Item identity = itemAt(ItemKind::Instruction, begin);
    identity.nameBegin = offset(name.begin());
    identity.nameEnd = offset(name.end());
    at_ = afterBlanks(at_) + 1; // the `=`
    scanArgument(identity, 0, /*words=*/true);
    add(identity);
    end = at_;
    skipBlanks();
    name = identifier();
    keyword = sinumerikKeyword(name);
    at_ = name.end();
  }
  if (keyword == Keyword::When) {
    addKeyword(name);
    scanActionCondition(item);
    end = at_;
    skipBlanks();
    name = identifier();
    keyword = sinumerikKeyword(name);
    at_ = name.end();
  }
  if (keyword != Keyword::Do) {
    if (block_.issues.size() == issues)
      issue(SyntaxIssueKind::BadStatement, begin, end);
    rest();
    return add(item);
  }
  Deeds deeds;
  skipBlanks();
  if (atBlockEnd() && block_.issues.size() == issues)
    issue(SyntaxIssueKind::BadStatement, begin, end);
  for (; !atBlockEnd(); skipBlanks())
    scanAction(deeds);
  // Only an action that may turn the spindle changes what is known of it.
  if (deeds.turns)
    addKeyword(name);
  add(item);
}

/// Perhaps with the units of its lengths before it: `WHEN G710 $AA_IW[X]>10`.
void SinumerikScanner::scanActionCondition(Item &item) {
  skipBlanks();
  const llvm::StringRef units = identifier();
  if (units.size() > 2 && (units[0] | 32) == 'g' && llvm::all_of(units.drop_front(), isNumberDigit))
    at_ = units.end();
  item.condition = condition();
}

/// `= value` after the name of an action; false: it has none.
bool SinumerikScanner::scanActionValue(llvm::StringRef name, const char *begin) {
  skipBlanks();
  skipIndices();
  const char *const end = at_;
  skipBlanks();
  if (!isEquals(at_)) {
    at_ = end;
    return false;
  }
  if (isMovingParameter(name)) {
    // From here on nobody knows its value.
    Item item = itemAt(ItemKind::Assignment, begin);
    item.nameBegin = offset(begin);
    item.nameEnd = offset(end);
    at_ = begin + 1;
    item.target = parsed(&SinumerikExpression::parseTarget);
    at_ = afterBlanks(end) + 1;
    expression();
    item.value = opaque(begin, at_);
    add(item);
    return true;
  }
  ++at_;
  WordReading reading;
  parsed(&SinumerikExpression::parseValue, reading);
  return true;
}

/// `M3`, `M45`; not `M8`, which switches the coolant, nor `M0`.
bool SinumerikScanner::mayTurnSpindle(llvm::StringRef number) const {
  uint32_t value = 0;
  constexpr uint32_t greatest = 999;
  if (number.getAsInteger(10, value) || value > greatest)
    return true;
  const CodeIndex code = dialect_.find('M', value * 10);
  if (code == noCode)
    return true;
  const Action action = dialect_.codes[code].action;
  return action != Action::CoolantOn && action != Action::CoolantOff &&
         action != Action::ProgramStop && action != Action::OptionalStop;
}

/// One of the actions after DO: an assignment, a word, a call.
void SinumerikScanner::scanAction(Deeds &deeds) {
  const char *const begin = at_;
  at_ += *at_ == '$';
  at_ += at_ < end_ && *at_ == '$';
  const llvm::StringRef name = identifier();
  if (name.empty()) {
    while (!atBlockEnd() && !isSinumerikBlank(*at_))
      ++at_;
    return issue(SyntaxIssueKind::BadStatement, begin, at_);
  }
  at_ = name.end();
  if (*begin == '$') {
    if (!scanActionValue({begin, size_t(end_ - begin)}, begin))
      issue(SyntaxIssueKind::MissingEquals, begin, at_);
    return;
  }
  if (isJump(sinumerikKeyword(name))) {
    rest();
    return issue(SyntaxIssueKind::NoAction, begin, at_);
  }
  const char letter = char(name[0] | 32);
  const llvm::StringRef number = name.drop_front();
  if (llvm::all_of(number, isNumberDigit)) {
    deeds.turns |= letter == 's' || (letter == 'm' && mayTurnSpindle(number));
    // The path is the program's own: of the G functions only the units of lengths are actions.
    const bool units = number == "70" || number == "71" || number == "700" || number == "710";
    const bool coordinate =
        letter >= 'x' && letter <= 'z' && !number.empty() && block_.issues.empty();
    if (letter == 'f' || letter == 't' || letter == 'd' || coordinate || (letter == 'g' && !units))
      issue(SyntaxIssueKind::NoAction, begin, at_);
    if (!scanActionValue(name, begin))
      skipNumberCharacters();
    return;
  }
  deeds.turns |= name.startswith_insensitive("SPOS");
  if (scanActionValue(name, begin))
    return;
  if (const CodeIndex code = dialect_.keyword(name);
      code != noCode && (dialect_.codes[code].action == Action::FrameSet ||
                         dialect_.codes[code].action == Action::FrameAdd))
    issue(SyntaxIssueKind::NoAction, begin, at_);
  // A name that the control does not have is a program that runs beside this one.
  deeds.turns |= dialect_.keyword(name) == noCode && !name.equals_insensitive("ELSE");
  if (const char *const after = afterBlanks(at_); after < end_ && *after == '(') {
    at_ = after;
    Item arguments = itemAt(ItemKind::Output, begin);
    scanArguments(arguments, /*words=*/false);
    add(arguments);
  }
}

/// Whether the block is a synchronised action: one of its words is at its head.
bool SinumerikExpression::isInAction(const char *at) const {
  constexpr size_t head = 80; // characters
  const char *const begin = base_ + block_.begin;
  llvm::StringRef text(begin, std::min(size_t(at - begin), head));
  while (!text.empty()) {
    const llvm::StringRef word = text.take_while(llvm::isAlpha);
    for (const char *keyword : {"WHEN", "WHENEVER", "EVERY", "FROM", "DO"})
      if (word.equals_insensitive(keyword))
        return true;
    text = text.drop_front(std::max<size_t>(word.size(), 1));
  }
  return false;
}

} // namespace ncvet
