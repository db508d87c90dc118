// Names in the items of a block: assignments, calls, jumps, brackets and expressions.
#include "lsp/features/name_pass.h"

namespace ncvet::lsp {

namespace {

bool isSpace(char c) { return c == ' ' || c == '\t'; }

} // namespace

void NamePass::item(const Item &item) {
  switch (item.kind) {
  case ItemKind::Assignment:
    return assignment(item);
  case ItemKind::Definition:
    defined_.insert({program_, block_.keyOf(item.target)});
    return addVariable(NameUse::Definition, block_.keyOf(item.target), item.nameBegin,
                       item.nameEnd);
  case ItemKind::Parameters:
    return parameters(item);
  case ItemKind::Declaration:
    return addProgram(NameUse::Declaration, item.nameBegin, item.nameEnd);
  case ItemKind::Macro: {
    const uint64_t key = programKey(text_.slice(item.nameBegin, item.nameEnd));
    macros_.insert({program_, key});
    add(NameKind::Macro, NameUse::Definition, key, item.nameBegin, item.nameEnd, program_);
    return;
  }
  case ItemKind::Structure:
    if (item.structure == Structure::For)
      return assignment(item);
    return bracket(item);
  case ItemKind::Input:
    if (item.target != noExpression)
      assignment(item);
    break;
  default:
    break;
  }
  references_.item(block_, item, text_, [this](const Reference &one) { reference(one); });
}

/// The variable that an item writes.
void NamePass::assignment(const Item &item) {
  if (item.target >= block_.expressions.size() || item.nameEnd <= item.nameBegin)
    return;
  const Expression &target = block_.expressions[item.target];
  llvm::StringRef name = text_.slice(item.nameBegin, item.nameEnd);
  uint64_t key = block_.keyOf(item.target);
  const ExpressionOp *const last =
      target.count ? &block_.operations[target.first + target.count - 1] : nullptr;
  if (!key && last && last->op == Op::ElementKey) {
    key = uint64_t(last->value); // of the array; which element does not matter
    name = name.take_until([](char c) { return c == '[' || isSpace(c); });
  }
  if (!key)
    return untold(&UntoldNames::variable, item.nameBegin);
  // `#[100]`, `# 1`, `#<name>`: its marks are no part of the name.
  llvm::StringRef bare = name.trim("# \t");
  if (bare.startswith("[") || bare.startswith("<"))
    bare = bare.trim("[]<> \t");
  const auto begin = uint32_t(bare.begin() - text_.begin());
  if (!bare.empty())
    addVariable(NameUse::Write, key, begin, begin + uint32_t(bare.size()));
}

/// `PROC NAME(REAL A, VAR INT B)`
void NamePass::parameters(const Item &item) {
  addProgram(NameUse::Declaration, item.nameBegin, item.nameEnd);
  for (const Argument &parameter : block_.argumentsOf(item)) {
    if (parameter.end <= parameter.begin)
      continue;
    const uint64_t key = variableKey(text_.slice(parameter.begin, parameter.end));
    defined_.insert({program_, key});
    addVariable(NameUse::Definition, key, parameter.begin, parameter.end);
  }
}

/// `o100 sub`, `o101 if [..]`: brackets with labels.
void NamePass::bracket(const Item &item) {
  if (!item.label || item.nameEnd <= item.nameBegin)
    return;
  const uint64_t key = labelKeyOf(*unit_.reader, text_.slice(item.nameBegin, item.nameEnd));
  const bool subprogram = item.structure == Structure::Sub || item.structure == Structure::EndSub ||
                          item.structure == Structure::Return;
  const NameUse use = item.structure == Structure::Sub ? NameUse::Definition : NameUse::Read;
  if (item.structure == Structure::EndSub && scope_ != program_) {
    scopes_[scope_].end = block_.next;
    scope_ = program_;
  }
  if (subprogram)
    add(NameKind::Subprogram, use, key, item.nameBegin, item.nameEnd, wholeFile);
  else
    add(NameKind::Bracket, use, key, item.nameBegin, item.nameEnd, scope_);
  if (item.structure == Structure::Sub) {
    scope_ = uint32_t(scopes_.size());
    scopes_.push_back({block_.begin, scopes_[program_].end, program_});
  }
}

/// The range of the variable's name that begins at `offset`, without its marks.
std::pair<uint32_t, uint32_t> NamePass::variableAt(uint32_t offset) const {
  const auto size = uint32_t(text_.size());
  uint32_t begin = offset;
  if (begin < size && text_[begin] == '#')
    ++begin;
  while (begin < size && isSpace(text_[begin]))
    ++begin;
  if (begin < size && text_[begin] == '<') {
    const size_t close = text_.find('>', ++begin);
    return {begin, close == llvm::StringRef::npos ? begin : uint32_t(close)};
  }
  uint32_t end = begin;
  while (end < size && (llvm::isAlnum(text_[end]) || text_[end] == '_' || text_[end] == '%'))
    ++end;
  return {begin, end};
}

/// Variables that the block reads.
void NamePass::operations() {
  for (size_t i = 0; i < block_.operations.size(); ++i) {
    const ExpressionOp &op = block_.operations[i];
    switch (op.op) {
    case Op::Variable:
    case Op::ElementAt:
    case Op::Exists: {
      const auto [begin, end] = variableAt(op.offset);
      if (end > begin)
        addVariable(NameUse::Read, uint64_t(op.value), begin, end);
      break;
    }
    case Op::VariableAt:
      // `#[100]` is `#100`.
      if (i > 0 && block_.operations[i - 1].op == Op::Number &&
          block_.operations[i - 1].offset > op.offset && block_.operations[i - 1].value >= 0 &&
          block_.operations[i - 1].value < 1e9) {
        const uint32_t begin = firstDigit(op.offset, uint32_t(text_.size()));
        addVariable(NameUse::Read, uint64_t(block_.operations[i - 1].value), begin,
                    endOfDigits(begin));
      } else {
        untold(&UntoldNames::variable, op.offset);
      }
      break;
    default:
      break;
    }
  }
}

} // namespace ncvet::lsp
