// Where a program gives the control data: blocks whose numbers are no block numbers.
#pragma once

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

namespace ncvet {

/// From a code of data to the code that ends them, in one program. Read when it is first asked.
class DataSections {
public:
  DataSections(const ProgramInfo &program, const Reader &reader, const Dialect &dialect)
      : program_(program), reader_(reader), dialect_(dialect) {}

  bool holds(uint32_t offset) {
    if (!read_)
      read();
    return llvm::any_of(sections_, [&](const auto &section) {
      return section.first < offset && offset < section.second;
    });
  }

private:
  void read() {
    read_ = true;
    if (llvm::none_of(dialect_.codes,
                      [](const CodeInfo &code) { return code.action == Action::DataInputEnd; }))
      return;
    std::optional<uint32_t> begin;
    for (const Block &block : blocks(reader_, program_.body, program_.end)) {
      if (!block.has(letterAddress('G')))
        continue;
      if (findCode(dialect_, block, {Action::DataInput})) {
        begin = block.begin;
      } else if (begin && findCode(dialect_, block, {Action::DataInputEnd})) {
        sections_.emplace_back(*begin, block.begin);
        begin.reset();
      }
    }
  }

  const ProgramInfo &program_;
  const Reader &reader_;
  const Dialect &dialect_;
  bool read_ = false;
  std::vector<std::pair<uint32_t, uint32_t>> sections_;
};

} // namespace ncvet
