// Reader of ECS programs: words, instructions and variables in angle brackets, labels, expressions.
#pragma once

#include "formats/readers/reader.h"

namespace ncvet {

class EcsReader final : public Reader {
public:
  EcsReader(const Dialect &dialect, llvm::StringRef text);
  void read(uint32_t offset, Block &block) const override;
  /// What is before a `:`, without blanks, eight characters of it (manual 786-801).
  std::string labelKey(llvm::StringRef label) const override;

private:
  const Dialect &dialect_;
  llvm::StringMap<AddressId> addresses_; ///< those of several letters
};

} // namespace ncvet
