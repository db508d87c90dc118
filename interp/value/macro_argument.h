// Which variable of a macro an argument of its call sets.
#pragma once

#include <cstdint>

namespace ncvet {

/// Number of the local variable that argument letter `letter` of a macro call sets, in the form in
/// which no letter is twice; 0: none.
constexpr uint32_t macroArgument(char letter) {
  constexpr uint32_t variables[26] = {1, 2, 3, 7,  8,  9,  0,  11, 4,  5,  6,  0,  13,
                                      0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};
  return letter >= 'A' && letter <= 'Z' ? variables[letter - 'A'] : 0;
}

} // namespace ncvet
