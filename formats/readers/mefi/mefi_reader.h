// Reader of MEFI programs: a block runs from one `N` to the next, over any number of lines.
#pragma once

#include "formats/readers/reader.h"

namespace ncvet {

class MefiReader final : public Reader {
public:
  MefiReader(const Dialect &dialect, llvm::StringRef text) : Reader(text), dialect_(dialect) {}
  void read(uint32_t offset, Block &block) const override;

private:
  const Dialect &dialect_;
};

} // namespace ncvet
