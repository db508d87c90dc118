// Reads blocks of a text that a test holds, and shows what they hold.
#pragma once

#include "formats/readers/select/make_reader.h"
#include "interp/evaluate/expression.h"
#include "interp/state/state.h"
#include "tests/support/run_program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace ncvet::test {

/// Tests of the reader of one built-in dialect derive from it.
class BlockReading : public testing::Test {
protected:
  explicit BlockReading(std::string dialect) : dialect_(std::move(dialect)) {}

  /// All blocks of `text`, which is kept; each begins after the one before.
  std::vector<Block> blocksOf(llvm::StringRef text) {
    text_ = text.str();
    reader_ = makeReader(*dialectNamed(dialect_), text_);
    std::vector<Block> blocks;
    for (uint32_t at = reader_->first(); at < text_.size(); at = blocks.back().next) {
      reader_->read(at, blocks.emplace_back());
      EXPECT_GT(blocks.back().next, at);
    }
    return blocks;
  }
  Block blockOf(llvm::StringRef text) { return blocksOf(text).front(); }
  /// Part of the text last read.
  llvm::StringRef spelling(uint32_t begin, uint32_t end) const {
    return llvm::StringRef(text_).slice(begin, end);
  }
  /// Value of expression `index` before anything was executed; NaN: it is not known.
  static double valueOf(const Block &block, uint16_t index) {
    const Value value = evaluate(block, index, MachineState(), nullptr);
    return value.isConstant() ? value.number.value() : std::nan("");
  }
  static std::vector<SyntaxIssueKind> issuesOf(const Block &block) {
    std::vector<SyntaxIssueKind> kinds;
    for (const SyntaxIssue &issue : block.issues)
      kinds.push_back(issue.kind);
    return kinds;
  }

  std::string text_;
  std::unique_ptr<Reader> reader_;

private:
  const std::string dialect_;
};

} // namespace ncvet::test
