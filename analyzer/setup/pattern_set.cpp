// Pattern set: regular expressions compiled together by RE2.
#include "analyzer/setup/pattern_set.h"

#include "formats/packed/shipped.h"
#include "formats/text/failure.h"
#include "formats/text/needed_text.h"

#include "llvm/ADT/StringExtras.h"
#include <re2/re2.h>
#include <re2/set.h>

#include <atomic>
#include <mutex>
#include <numeric>

namespace ncvet {

namespace {

/// For the automaton of all patterns together, which grows with what was looked at. The marks of
/// the built-in tables and 1,400 programs of many controls need 5 MB.
constexpr int64_t mostMemory = 64 << 20;

re2::RE2::Options options() {
  re2::RE2::Options options;
  options.set_encoding(re2::RE2::Options::EncodingLatin1); // any bytes are a text
  options.set_max_mem(mostMemory);
  options.set_log_errors(false);
  return options;
}

using Set = re2::RE2::Set;

/// Whether the pattern may match in the text.
bool mayMatch(const std::string &pattern, const HeldTexts &text) {
  const auto &shipped = shippedNeededTexts();
  const auto known = shipped.find(pattern);
  return text.holdsAny(known == shipped.end() ? neededTexts(pattern) : known->second);
}

} // namespace

struct PatternSet::Compiled {
  /// The patterns with these numbers, or all.
  llvm::Expected<std::unique_ptr<Set>> make(llvm::ArrayRef<size_t> numbers) const;
  const Set *all();

  std::vector<std::string> patterns;
  std::atomic<bool> wasAsked = false; ///< for a text, or all of them are made
  std::once_flag once;
  std::unique_ptr<Set> whole; ///< null while it is not made, or cannot be
  std::string wrong;          ///< why it cannot
};

PatternSet::PatternSet() : compiled_(std::make_unique<Compiled>()) {}
PatternSet::PatternSet(PatternSet &&other) noexcept = default;
PatternSet &PatternSet::operator=(PatternSet &&other) noexcept = default;
PatternSet::~PatternSet() = default;

size_t PatternSet::add(llvm::StringRef pattern) {
  compiled_->patterns.push_back(pattern.str());
  return compiled_->patterns.size() - 1;
}

llvm::Error PatternSet::check(llvm::StringRef pattern) {
  Set set(options(), re2::RE2::UNANCHORED);
  std::string why;
  if (set.Add({pattern.data(), pattern.size()}, &why) < 0)
    return failure("pattern \"" + pattern + "\": " + why);
  return llvm::Error::success();
}

llvm::Expected<std::unique_ptr<Set>>
PatternSet::Compiled::make(llvm::ArrayRef<size_t> numbers) const {
  auto set = std::make_unique<Set>(options(), re2::RE2::UNANCHORED);
  for (const size_t number : numbers) {
    std::string why;
    if (set->Add(patterns[number], &why) < 0)
      return failure("pattern \"" + patterns[number] + "\": " + why);
  }
  if (!set->Compile())
    return failure("the patterns of all marks need too much memory");
  return set;
}

const Set *PatternSet::Compiled::all() {
  wasAsked = true;
  std::call_once(once, [this] {
    std::vector<size_t> numbers(patterns.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    if (auto made = make(numbers))
      whole = std::move(*made);
    else
      wrong = llvm::toString(made.takeError());
  });
  return whole.get();
}

llvm::Error PatternSet::compile() const {
  if (!compiled_->all())
    return failure(compiled_->wrong);
  return llvm::Error::success();
}

llvm::SmallVector<int, 16> PatternSet::matching(llvm::StringRef line) const {
  std::vector<int> found;
  if (const Set *all = compiled_->all())
    all->Match({line.data(), line.size()}, &found);
  return {found.begin(), found.end()};
}

std::vector<bool> PatternSet::inLines(llvm::ArrayRef<std::string> lines) const {
  const std::vector<std::string> &patterns = compiled_->patterns;
  std::vector<size_t> numbers;
  std::unique_ptr<Set> few;
  const Set *set = nullptr;
  if (!compiled_->wasAsked.exchange(true)) {
    const std::string text = llvm::join(lines, "\n");
    const HeldTexts held(text);
    for (size_t i = 0; i < patterns.size(); ++i)
      if (mayMatch(patterns[i], held))
        numbers.push_back(i);
    if (auto made = compiled_->make(numbers))
      set = (few = std::move(*made)).get();
    else
      llvm::consumeError(made.takeError()); // all of them are tried, whose error is told
  }
  if (!set) {
    numbers.clear();
    set = compiled_->all();
  }
  std::vector<bool> found(patterns.size());
  std::vector<int> inLine;
  for (const std::string &line : lines)
    if (set && set->Match(line, &inLine))
      for (const int index : inLine)
        found[few ? numbers[size_t(index)] : size_t(index)] = true;
  return found;
}

} // namespace ncvet
