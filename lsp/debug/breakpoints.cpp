// Places and conditions at which a dry run stops.
#include "lsp/debug/breakpoints.h"

#include "formats/text/failure.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet::dap {

llvm::Expected<HitCount> HitCount::parse(llvm::StringRef text) {
  HitCount count;
  text = text.trim();
  if (text.empty())
    return count;
  count.kind_ = Kind::Equal;
  for (const auto &[sign, kind] :
       {std::pair(">=", Kind::MoreEqual), std::pair("<=", Kind::LessEqual),
        std::pair("==", Kind::Equal), std::pair("!=", Kind::NotEqual), std::pair(">", Kind::More),
        std::pair("<", Kind::Less), std::pair("=", Kind::Equal), std::pair("%", Kind::Every)})
    if (text.consume_front(sign)) {
      count.kind_ = kind;
      break;
    }
  if (text.trim().getAsInteger(10, count.number_) || (count.kind_ == Kind::Every && !count.number_))
    return failure("a hit count is a number, perhaps after one of >= <= == != > < %");
  return count;
}

bool HitCount::holds(uint64_t hits) const {
  switch (kind_) {
  case Kind::Always:
    return true;
  case Kind::Equal:
    return hits == number_;
  case Kind::NotEqual:
    return hits != number_;
  case Kind::Less:
    return hits < number_;
  case Kind::LessEqual:
    return hits <= number_;
  case Kind::More:
    return hits > number_;
  case Kind::MoreEqual:
    return hits >= number_;
  case Kind::Every:
    return hits % number_ == 0;
  }
  return true;
}

llvm::Error Breakpoint::readMessage(const FileUnit &unit, llvm::StringRef text) {
  while (!text.empty()) {
    const auto [plain, rest] = text.split('{');
    Piece piece{plain.str(), std::nullopt};
    text = rest;
    if (!rest.empty()) {
      const auto [inner, after] = rest.split('}');
      auto value = WatchedValue::parse(unit, inner);
      if (!value)
        return value.takeError();
      piece.value = std::move(*value);
      text = after;
    }
    message_.push_back(std::move(piece));
  }
  return llvm::Error::success();
}

llvm::Expected<Breakpoint> Breakpoint::make(const FileUnit &unit, const BreakpointWish &wish,
                                            int id) {
  Breakpoint made(id);
  if (!llvm::StringRef(wish.condition).trim().empty()) {
    auto condition = WatchedCondition::parse(unit, wish.condition);
    if (!condition)
      return condition.takeError();
    made.condition_ = std::move(*condition);
  }
  auto count = HitCount::parse(wish.hitCondition);
  if (!count)
    return count.takeError();
  made.count_ = *count;
  if (llvm::Error wrong = made.readMessage(unit, wish.logMessage))
    return wrong;
  return made;
}

bool Breakpoint::hit(const MachineState &state) {
  // Where it is not known whether the condition holds, whoever looks decides.
  if (condition_ && condition_->holds(state) == Truth::No)
    return false;
  return count_.holds(++hits_);
}

std::string Breakpoint::message(const MachineState &state) const {
  std::string text;
  for (const Piece &piece : message_) {
    text += piece.text;
    if (piece.value)
      text += valueText(piece.value->evaluate(state));
  }
  return text;
}

void Breakpoints::forgetHits() {
  for (auto &[place, all] : atBlocks)
    for (Breakpoint &one : all)
      one.forgetHits();
  for (auto &[name, one] : atPrograms)
    one.forgetHits();
}

std::string programKeyOf(llvm::StringRef name) {
  std::string key = name.trim().upper();
  llvm::StringRef digits = key;
  if (!digits.consume_front("O"))
    digits.consume_front(":");
  if (digits.empty() || !llvm::all_of(digits, llvm::isDigit))
    return key;
  digits = digits.ltrim('0');
  return digits.empty() ? "0" : digits.str();
}

} // namespace ncvet::dap
