// What emscripten's C++ library lacks of C++20, for all sources that are compiled for it.
#pragma once

// Sizes have 32 bits there. What is counted in 64 bits elsewhere is of texts, which are shorter.
#pragma clang diagnostic ignored "-Wshorten-64-to-32"

#include <unordered_map> // which its other headers do not bring along, as those of g++ do
