// What called programs have done: what an edit does to it, and how much of it is kept.
#include "analyzer/reuse/known_calls.h"

namespace ncvet {

namespace {

/// Some ten kilobytes each.
constexpr size_t mostCalls = 2048;
/// States in which one block calls its program, in a loop or before and after an edit.
constexpr size_t mostOfOne = 2;

bool touches(const TextChange &change, uint32_t from, uint32_t to) {
  return change.begin <= to && change.end >= from;
}

} // namespace

/// It is the body where nothing else tells two of them apart: 64 bits on every machine.
uint64_t BodyRun::print() const {
  constexpr uint64_t spread = 0x9E3779B97F4A7C15;
  uint64_t number = state;
  for (const uint64_t part : {uint64_t(start) << 32 | end, uint64_t(kind)}) {
    number = (number ^ part) * spread;
    number ^= number >> 31;
  }
  return number >> 1; // the largest are marks of `llvm::DenseSet`
}

void BodyRun::move(const TextChange &change) {
  start = change.moved(start);
  if (end != ~0u)
    end = change.moved(end);
}

bool KnownCall::isSpoilt(const TextChange &change) const {
  return touches(change, next, next) || run.stemsFrom(change) ||
         llvm::any_of(texts,
                      [&](const auto &text) { return touches(change, text.first, text.second); });
}

void KnownCall::move(const TextChange &change, StraightRun::Moved &moved) {
  body.move(change);
  next = change.moved(next);
  run.move(change, moved);
  for (auto *list : {&texts, &covered})
    for (auto &[begin, end] : *list) {
      begin = change.moved(begin);
      end = change.moved(end);
    }
  for (auto *bodies : {&inner, &recalled})
    for (BodyRun &one : *bodies)
      one.move(change);
}

void KnownCalls::edit(const TextChange &change, StraightRun::Moved &moved) {
  const bool moves = change.end != change.endAfter(); // else all places stay
  auto before = std::exchange(calls_, {});
  count_ = 0;
  for (auto &[at, calls] : before)
    for (auto &call : calls) {
      if (call->isSpoilt(change))
        continue;
      if (moves)
        call->move(change, moved);
      calls_[{call->body.start, call->next}].push_back(std::move(call));
      ++count_;
    }
}

const KnownCall *KnownCalls::find(uint32_t start, uint32_t next,
                                  llvm::function_ref<bool(const KnownCall &)> fits) const {
  const auto at = calls_.find({start, next});
  if (at == calls_.end())
    return nullptr;
  const auto found = llvm::find_if(at->second, [&](const auto &call) { return fits(*call); });
  return found == at->second.end() ? nullptr : found->get();
}

void KnownCalls::insert(KnownCall call) {
  if (isPlain_ && !call.inner.empty())
    return;
  auto &calls = calls_[{call.body.start, call.next}];
  if (calls.size() == mostOfOne) {
    calls.erase(calls.begin());
    --count_;
  }
  if (count_ < mostCalls) {
    calls.push_back(std::make_unique<KnownCall>(std::move(call)));
    ++count_;
  }
}

void KnownCalls::keepPlain() {
  isPlain_ = true;
  for (auto &[at, calls] : calls_)
    llvm::erase_if(calls, [&](const auto &call) {
      const bool isLost = !call->inner.empty();
      count_ -= isLost;
      return isLost;
    });
}

} // namespace ncvet
