// What a word is for: the code that reads it, its role there, and the value that counts.
#pragma once

#include "formats/dialect/machine.h"
#include "formats/readers/block.h"

#include <memory>
#include <optional>
#include <string>

namespace ncvet {
class Executor;       // interp/execute/execute.h
struct ExecutedBlock; // interp/state/executed_block.h
struct MachineState;  // interp/state/state.h
} // namespace ncvet

namespace ncvet::lsp {

/// The code that reads a word, with its variant resolved, and the word's place in the code's
/// format. Null: no code, or its format does not name the word.
struct WordUse {
  const CodeInfo *code = nullptr;
  const WordSpec *spec = nullptr;
};

/// Who reads `word` of an executed block: a code of the block, else one that is certainly active.
WordUse useOf(const ExecutedBlock &executed, const Word &word);
/// The key of the variable that a word of `variableAddress` sets; 0: none.
uint64_t variableOf(const Block &block, const Word &word);

/// A word's value with its unit.
struct EffectiveValue {
  std::string text;
  bool hidden = false; ///< another one than the digits show: 2 ms of `P2`, 0.1 mm of `X100`
};
/// None when it is not certain.
std::optional<EffectiveValue> effectiveValue(const ExecutedBlock &executed, const Word &word,
                                             const WordUse &use);

/// A block of a text, executed on a state by itself; of the state nothing is known by default.
class LoneBlock {
public:
  LoneBlock(const Dialect &dialect, const MachineProfile &machine, const Executor &executor,
            Block block, const MachineState *before = nullptr);
  ~LoneBlock();
  LoneBlock(const LoneBlock &) = delete;
  LoneBlock &operator=(const LoneBlock &) = delete;

  const Block &block() const;
  const ExecutedBlock &executed() const;

private:
  struct Execution;
  const std::unique_ptr<const Execution> execution_;
};

} // namespace ncvet::lsp
