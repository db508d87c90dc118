// Stages of the tool alone, timed by Google Benchmark: ./dev bench, or this binary with its
// options.
#include "formats/dialect/control_facts.h"
#include "formats/dialect/loader.h"
#include "formats/readers/select/make_reader.h"
#include "formats/text/source.h"
#include "interp/execute/execute.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace ncvet;

/// Blocks of a 3D finishing pass, as the whole-process programs have them.
std::string surfacingText(int blocks) {
  std::string text = "%\nO1001\nG21 G17 G40 G49 G80 G90 G94\nG1 X0. Y0. Z0. F2400.\n";
  char block[64];
  for (int i = 0; i < blocks; ++i) {
    std::snprintf(block, sizeof block, "X%.3f Y%.3f Z-%.4f\n", 0.487 * (i % 400), 0.02 * (i % 7),
                  6.0 + 0.0137 * (i % 97));
    text += block;
  }
  return text + "M30\n%\n";
}

/// The round of a macro that computes its positions, over and over.
std::string macroText(int rounds) {
  std::string text = "%\nO1004\n";
  for (int i = 0; i < rounds; ++i)
    text += "N10 #106=#105*0.5\n#107=3.*SIN[#106*4.]*COS[#104*3.]\nIF [#107 GT 0.25] GOTO 10\n"
            "G1 X#106 Y[#104+0.1] Z-#108 F2400. (FINISH)\n";
  return text + "M30\n%\n";
}

/// A word-address control with the usual spelling: the reader asks for no more of a table.
Dialect wordAddressDialect() {
  Dialect dialect;
  dialect.id = "bench";
  dialect.reader = "iso";
  dialect.facts = std::make_shared<ControlFacts>();
  return dialect;
}

/// Reads all blocks of `text` again and again; blocks are counted as items.
void readAll(benchmark::State &state, const Dialect &dialect, const std::string &text) {
  const std::unique_ptr<Reader> reader = makeReader(dialect, text);
  Block block;
  int64_t blocks = 0;
  size_t words = 0;
  for (auto _ : state) {
    for (uint32_t offset = reader->first(); offset < text.size(); offset = block.next) {
      reader->read(offset, block);
      words += block.words.size();
      ++blocks;
    }
  }
  benchmark::DoNotOptimize(words);
  state.SetItemsProcessed(blocks);
  state.SetBytesProcessed(static_cast<int64_t>(state.iterations()) *
                          static_cast<int64_t>(text.size()));
}

void readSurfacing(benchmark::State &state) {
  readAll(state, wordAddressDialect(), surfacingText(100'000));
}
BENCHMARK(readSurfacing)->Unit(benchmark::kMillisecond);

void readMacro(benchmark::State &state) { readAll(state, wordAddressDialect(), macroText(25'000)); }
BENCHMARK(readMacro)->Unit(benchmark::kMillisecond);

/// The same million numbered blocks in every language: what one reader costs beside the others.
void readNumbered(benchmark::State &state, const char *id) {
  auto dialect = loadDialect(id, builtinDialects());
  if (!dialect)
    return state.SkipWithError("the built-in table does not load");
  std::string text;
  char block[64];
  for (int i = 0; i < 1'000'000; ++i) {
    std::snprintf(block, sizeof block, "N%d X%.3f Y%.3f Z-%.4f\n", i + 1, 0.487 * (i % 400),
                  0.02 * (i % 7), 6.0 + 0.0137 * (i % 97));
    text += block;
  }
  readAll(state, **dialect, text);
}
BENCHMARK_CAPTURE(readNumbered, iso, "fanuc-0m")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(readNumbered, ecs, "ecs")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(readNumbered, mefi, "mefi")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(readNumbered, sinumerik, "sinumerik")->Unit(benchmark::kMillisecond);

/// Executes blocks that were read before, over and over: the transfer function alone.
void executeSurfacing(benchmark::State &state) {
  auto dialect = loadDialect("fanuc-0m", builtinDialects());
  if (!dialect)
    return state.SkipWithError("the built-in table does not load");
  const std::string text = surfacingText(2'000);
  const std::unique_ptr<Reader> reader = makeReader(**dialect, text);
  std::vector<Block> blocks;
  for (uint32_t offset = reader->first(); offset < text.size(); offset = blocks.back().next)
    reader->read(offset, blocks.emplace_back());
  const MachineProfile machine;
  const Executor executor(**dialect, machine, 0);
  Outcome outcome;
  MachineState after = initialState(**dialect);
  for (auto _ : state)
    for (const Block &block : blocks) {
      const MachineState &before = after; // no rule looks at it here
      executor.execute(block, before, after, outcome);
    }
  benchmark::DoNotOptimize(after);
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations() * blocks.size()));
}
BENCHMARK(executeSurfacing)->Unit(benchmark::kMicrosecond);

/// One position in a large file, as a report needs it for its first finding.
void firstPositionOfALargeFile(benchmark::State &state) {
  const std::string text = surfacingText(100'000);
  const auto middle = static_cast<uint32_t>(text.size() / 2);
  for (auto _ : state) {
    const auto file = SourceFile::fromText(0, "bench.nc", text);
    benchmark::DoNotOptimize(file->position(middle));
  }
  state.SetBytesProcessed(static_cast<int64_t>(state.iterations()) *
                          static_cast<int64_t>(text.size()));
}
BENCHMARK(firstPositionOfALargeFile)->Unit(benchmark::kMicrosecond);

/// Further positions: the index is there.
void positionsOfALargeFile(benchmark::State &state) {
  const std::string text = surfacingText(100'000);
  const auto file = SourceFile::fromText(0, "bench.nc", text);
  uint32_t offset = 0;
  for (auto _ : state) {
    offset = (offset + 65'537) % static_cast<uint32_t>(text.size());
    benchmark::DoNotOptimize(file->position(offset));
  }
}
BENCHMARK(positionsOfALargeFile);

} // namespace

BENCHMARK_MAIN();
