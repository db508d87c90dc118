// The block that holds a place of a text: read from the begin of the line on.
#include "analyzer/program/block_reading.h"

namespace ncvet {

void readBlockAt(const SourceFile &source, const Reader &reader, uint32_t offset, Block &block) {
  block.clear();
  block.begin = block.end = block.next = offset;
  uint32_t at = std::max(source.lines().lineBegin(offset), source.textBegin());
  while (at < source.text().size()) { // several blocks may be on one line
    reader.read(at, block);
    if (block.next > offset || block.next <= at)
      break;
    at = block.next;
  }
}

} // namespace ncvet
