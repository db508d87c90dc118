// How a block is spelled, its coordinates aside.
#pragma once

#include "formats/readers/block.h"

namespace ncvet {

/// A number for how a block is spelled: its words in their order with the spelling of their
/// numbers, of addresses other than `free` their values too, whether it has a number and a comment.
/// 0: it holds more than plain words, perhaps with a number before them and a comment after them.
uint64_t spellingOf(const Block &block, AddressMask free);

} // namespace ncvet
