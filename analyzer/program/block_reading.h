// The block that holds a place of a text.
#pragma once

#include "formats/readers/reader.h"
#include "formats/text/source.h"

namespace ncvet {

/// Reads the block that holds the byte `offset` into `block`. After the last block it is empty.
void readBlockAt(const SourceFile &source, const Reader &reader, uint32_t offset, Block &block);

} // namespace ncvet
