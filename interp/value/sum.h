// Folds numbers into one.
#pragma once

#include "interp/value/value.h"

#include "llvm/ADT/bit.h"

#include <cstdint>

namespace ncvet {

/// A number for a sequence of numbers. Two sums are equal by chance once in 2^64: nobody checks so
/// many blocks.
class Sum {
public:
  explicit Sum(uint64_t first) : sum_(first) {}
  void add(uint64_t number) {
    constexpr uint64_t odd = 0x9E3779B97F4A7C15; // the golden ratio: spreads small numbers
    sum_ = (sum_ ^ number) * odd;
    sum_ ^= sum_ >> 29;
  }
  void add(const Interval &value) {
    add(llvm::bit_cast<uint64_t>(value.lo));
    add(llvm::bit_cast<uint64_t>(value.hi));
  }
  /// Never 0.
  uint64_t get() const { return sum_ ? sum_ : 1; }

private:
  uint64_t sum_;
};

} // namespace ncvet
