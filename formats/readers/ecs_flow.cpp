// Flow instructions of ECS blocks: jumps, choices, repeats.
#include "formats/readers/ecs_scanner.h"

namespace ncvet {

/// The program in which a jump's target lies.
void EcsScanner::scanOtherProgram(Item &item, const char *begin) {
  nameItem(item, scanProgramName());
  if (!scanSeparator())
    issue(SyntaxIssueKind::MissingArgument, begin, at_);
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

/// Behind the expression of a choice something else than `:` stands, mostly a comparison
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
  if (other)
    scanOtherProgram(item, begin);
  unsigned targets = 0;
  for (char separator = 0;; ++targets) {
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
    if (scanSeparator()) {
      const Argument count = scanArgument(separator);
      if (count.expression != noExpression)
        item.count = count.expression;
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
