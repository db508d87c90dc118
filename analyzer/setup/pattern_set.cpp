// Pattern set: regular expressions compiled together by RE2.
#include "analyzer/setup/pattern_set.h"

#include "formats/text/failure.h"

#include <re2/re2.h>
#include <re2/set.h>

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

} // namespace

struct PatternSet::Compiled {
  re2::RE2::Set set{options(), re2::RE2::UNANCHORED};
};

PatternSet::PatternSet() : compiled_(std::make_unique<Compiled>()) {}
PatternSet::PatternSet(PatternSet &&other) noexcept = default;
PatternSet &PatternSet::operator=(PatternSet &&other) noexcept = default;
PatternSet::~PatternSet() = default;

llvm::Expected<size_t> PatternSet::add(llvm::StringRef pattern) {
  std::string why;
  const int number = compiled_->set.Add({pattern.data(), pattern.size()}, &why);
  if (number < 0)
    return failure("pattern \"" + pattern + "\": " + why);
  return size_t(number);
}

llvm::Error PatternSet::compile() {
  if (!compiled_->set.Compile())
    return failure("the patterns of all marks need too much memory");
  return llvm::Error::success();
}

llvm::SmallVector<int, 16> PatternSet::matching(llvm::StringRef line) const {
  std::vector<int> found;
  compiled_->set.Match({line.data(), line.size()}, &found);
  return {found.begin(), found.end()};
}

} // namespace ncvet
