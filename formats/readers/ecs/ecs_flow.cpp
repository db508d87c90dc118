// Flow instructions of ECS blocks: jumps, choices, repeats.
#include "formats/readers/ecs/ecs_scanner.h"

namespace ncvet {

/// The program in which a jump's target lies; gives the separator after it.
char EcsScanner::scanOtherProgram(Item &item, const char *begin) {
  nameItem(item, scanProgramName());
  const char separator = scanSeparator();
  if (!separator)
    issue(SyntaxIssueKind::MissingArgument, begin, at_);
  return separator;
}

/// `<JMP:N50>`, `<JMP:[A]>`, `<JMC: PROG; N50>`
void EcsScanner::scanJump(const char *begin, bool other) {
  Item item = itemAt(ItemKind::Jump, begin);
  if (other)
    scanOtherProgram(item, begin);
  block_.arguments.push_back(scanTarget(0));
  if (scanSeparator())
    tooManyArguments(begin);
  closeAngle(begin);
  add(item);
}

/// After the expression of a choice comes something else than `:`, mostly a comparison
/// (`<IFF<R1 > 5>:`): one report, and reading goes on at the targets.
void EcsScanner::missingColon(const char *begin) {
  const llvm::StringRef rest(at_, size_t(end_ - at_));
  const size_t colon = rest.find_first_of(":;\r\n");
  if (colon == llvm::StringRef::npos || rest[colon] != ':')
    return issue(SyntaxIssueKind::BadStatement, begin, at_);
  at_ += colon;
  const char *const expression = std::find(begin + 1, at_, '<');
  issue(SyntaxIssueKind::BadExpression, expression, at_);
  ++at_;
}

/// `<IFF<R1-5>: N10; N20; N30>`, `<IFC<R1>: PROG; N10; N20; N30>`
void EcsScanner::scanChoice(const char *begin, bool other) {
  Item item = itemAt(ItemKind::Jump, begin);
  item.jump = JumpKind::BySign;
  item.condition = bracketed();
  skipBlanks();
  if (at_ < end_ && *at_ == ':')
    ++at_;
  else
    missingColon(begin);
  char separator = other ? scanOtherProgram(item, begin) : char(0);
  unsigned targets = 0;
  for (;; ++targets) {
    const Argument target = scanTarget(separator);
    if (target.kind == ArgumentKind::Empty)
      break;
    if (targets < 3)
      block_.arguments.push_back(target);
    separator = scanSeparator();
    if (!separator) {
      ++targets;
      break;
    }
  }
  closeAngle(begin);
  if (targets != 3)
    issue(targets < 3 ? SyntaxIssueKind::MissingArgument : SyntaxIssueKind::TooManyArguments, begin,
          at_);
  add(item);
}

/// `<RPT:N10;N20;3>`
void EcsScanner::scanRepeat(const char *begin) {
  Item item = itemAt(ItemKind::Repeat, begin);
  block_.arguments.push_back(scanTarget(0));
  const char separator = scanSeparator();
  if (separator) {
    block_.arguments.push_back(scanTarget(separator));
    if (const char second = scanSeparator()) {
      const Argument count = scanArgument(second);
      if (count.expression != noExpression)
        item.count = count.expression;
      // The count is no place of the program: the separator before it is kept with the first.
      block_.arguments[item.firstArgument].separator = second;
      if (scanSeparator())
        tooManyArguments(begin);
    }
  } else {
    issue(SyntaxIssueKind::MissingArgument, begin, at_);
  }
  closeAngle(begin);
  add(item);
}

} // namespace ncvet
