// Whether two texts of a block mean the same: all that a reader tells, without offsets.
#include "lsp/features/same_block.h"

#include "llvm/ADT/STLExtras.h"

namespace ncvet::lsp {

namespace {

class Comparison {
public:
  Comparison(const Block &a, llvm::StringRef textOfA, const Block &b, llvm::StringRef textOfB)
      : a_(a), b_(b), textOfA_(textOfA), textOfB_(textOfB) {}

  bool same() const {
    return sameHead() && all(a_.words, b_.words) && all(a_.items, b_.items) &&
           all(a_.arguments, b_.arguments) && all(a_.expressions, b_.expressions) &&
           all(a_.operations, b_.operations) && all(a_.comments, b_.comments) &&
           all(a_.issues, b_.issues);
  }

private:
  bool spelled(uint32_t beginA, uint32_t endA, uint32_t beginB, uint32_t endB) const {
    return textOfA_.slice(beginA, endA) == textOfB_.slice(beginB, endB);
  }

  bool sameHead() const {
    return a_.kind == b_.kind && a_.skip == b_.skip && a_.lowerCase == b_.lowerCase &&
           a_.tapeInside == b_.tapeInside && a_.numberIsFirst == b_.numberIsFirst &&
           a_.number == b_.number && a_.program == b_.program && a_.mainBlock == b_.mainBlock &&
           spelled(a_.nameBegin, a_.nameEnd, b_.nameBegin, b_.nameEnd) &&
           spelled(a_.labelBegin, a_.labelEnd, b_.labelBegin, b_.labelEnd) &&
           spelled(a_.headerBegin, a_.headerEnd, b_.headerBegin, b_.headerEnd);
  }

  template <typename List>
  bool all(const List &a, const List &b) const {
    if (a.size() != b.size())
      return false;
    for (size_t i = 0; i < a.size(); ++i)
      if (!equal(a[i], b[i]))
        return false;
    return true;
  }

  bool equal(const Word &a, const Word &b) const {
    return a.address == b.address && a.flags == b.flags && a.decimals == b.decimals &&
           a.mantissa == b.mantissa;
  }
  bool equal(const Item &a, const Item &b) const {
    return a.kind == b.kind && a.loop == b.loop && a.structure == b.structure && a.jump == b.jump &&
           a.type == b.type && a.single == b.single && a.modal == b.modal &&
           a.external == b.external && a.restores == b.restores && a.positional == b.positional &&
           a.label == b.label && a.wordsBefore == b.wordsBefore && a.target == b.target &&
           a.value == b.value && a.condition == b.condition && a.count == b.count &&
           a.limit == b.limit && a.firstArgument == b.firstArgument && a.arguments == b.arguments &&
           spelled(a.nameBegin, a.nameEnd, b.nameBegin, b.nameEnd);
  }
  bool equal(const Argument &a, const Argument &b) const {
    return a.kind == b.kind && a.separator == b.separator && a.type == b.type &&
           a.byReference == b.byReference && a.expression == b.expression &&
           spelled(a.begin, a.end, b.begin, b.end) &&
           spelled(a.nameBegin, a.nameEnd, b.nameBegin, b.nameEnd);
  }
  bool equal(const Expression &a, const Expression &b) const {
    return a.first == b.first && a.count == b.count && a.bad == b.bad;
  }
  bool equal(const ExpressionOp &a, const ExpressionOp &b) const {
    return a.op == b.op && (a.value == b.value || (a.value != a.value && b.value != b.value));
  }
  bool equal(const Comment &a, const Comment &b) const {
    return a.shown == b.shown && spelled(a.begin, a.end, b.begin, b.end);
  }
  bool equal(const SyntaxIssue &a, const SyntaxIssue &b) const { return a.kind == b.kind; }

  const Block &a_, &b_;
  const llvm::StringRef textOfA_, textOfB_;
};

} // namespace

bool sameBlock(const Block &a, llvm::StringRef textOfA, const Block &b, llvm::StringRef textOfB) {
  return Comparison(a, textOfA, b, textOfB).same();
}

} // namespace ncvet::lsp
