// What should be a program of its own: equal sequences of blocks, and a profile inside the main
// program.
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"

#include "llvm/Support/xxhash.h"

#include <unordered_map>

namespace ncvet {
namespace {

struct StyleUseSubprogramMemory {
  struct Line {
    uint64_t text = 0; ///< hash of what the block does, without number, comments and blanks
    uint32_t begin = 0, end = 0;
    bool moves = false;
  };
  uint32_t said = ~0u; ///< the recording that was reported last
  std::vector<Line> lines;
};

class StyleUseSubprogram final : public StatefulRule<StyleUseSubprogramMemory> {
public:
  void listen(Subscriptions &to) override {
    const double blocks = to.number("blocks", 5);
    run_ = blocks > 0 ? size_t(std::max(2.0, blocks)) : 0;
    if (llvm::any_of(to.dialect().codes,
                     [](const CodeInfo &code) { return code.action == Action::ProfileBegin; }))
      to.on(EventKind::Motion);
  }

  /// A move of a profile that is recorded where it is used.
  void on(const Event &event, RuleContext &ctx) const override {
    const Origin &begin = ctx.before().origin.of(StatePart::Roughing);
    if (ctx.before().profile != ProfileMode::Recorded || ctx.callDepth() > 0 || !event.axes ||
        !begin.known() || begin.begin == memory().said)
      return;
    memory().said = begin.begin;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("this profile is recorded in the middle of the main program: in a program of "
                   "its own it can be used again")
          .note(begin, "it is recorded from here on");
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    constexpr size_t readable = 1u << 20; // a program that long was made by a machine
    if (!run_ || file.source.text().size() > readable)
      return;
    for (const ProgramInfo &program : file.index.programs())
      look(program, file, ctx);
  }

private:
  void look(const ProgramInfo &program, const FileSummary &file, RuleContext &ctx) const {
    read(program, file, ctx.dialect());
    std::unordered_map<uint64_t, size_t> first; // sequence, and where it began first
    for (size_t at = 0; at + run_ <= memory().lines.size(); ++at) {
      const std::optional<uint64_t> key = sequenceAt(at);
      if (!key)
        continue;
      const auto [known, fresh] = first.try_emplace(*key, at);
      const size_t before = known->second;
      if (fresh || before + run_ > at)
        continue;
      size_t length = run_;
      while (before + length < at && at + length < memory().lines.size() &&
             memory().lines[before + length].text == memory().lines[at + length].text)
        ++length;
      if (auto finding = ctx.report(range(before, file)))
        finding
            .message(
                "the {0} blocks from here on are repeated in the program: a subprogram keeps them "
                "in one place",
                length)
            .note(range(at, file), "here");
      return; // one example says it
    }
  }

  SourceRange range(size_t at, const FileSummary &file) const {
    return {file.source.id(), memory().lines[at].begin, memory().lines[at].end};
  }

  void read(const ProgramInfo &program, const FileSummary &file, const Dialect &dialect) const {
    memory().lines.clear();
    std::string text;
    for (const Block &block : blocks(file.reader, program.begin, program.end)) {
      if (block.isEmpty())
        continue;
      Memory::Line line;
      line.begin = block.begin;
      line.end = block.end;
      text.clear();
      const auto add = [&](uint32_t begin, uint32_t end) {
        text += file.source.text(begin, end);
        text += ' ';
      };
      for (const Word &word : block.words) {
        if (word.address != letterAddress('N'))
          add(word.offset, block.endOf(word));
        line.moves |= (dialect.axisWords & maskOf(word.address)) != 0;
      }
      for (const Item &item : block.items)
        add(item.begin, item.end);
      line.text = llvm::xxHash64(text);
      memory().lines.push_back(line);
    }
  }

  /// Key of the sequence that begins at `at`; none when it is one block over and over, or hardly
  /// moves: what begins and ends the work of a tool is alike everywhere.
  std::optional<uint64_t> sequenceAt(size_t at) const {
    uint64_t key = 0;
    size_t moves = 0;
    bool differ = false;
    for (size_t i = 0; i < run_; ++i) {
      const Memory::Line &line = memory().lines[at + i];
      key = key * 0x9E3779B97F4A7C15u + line.text;
      moves += line.moves;
      differ |= line.text != memory().lines[at].text;
    }
    if (!differ || moves + 1 < run_)
      return std::nullopt;
    return key;
  }

  size_t run_ = 5; ///< blocks of the shortest sequence; 0: the control has no subprograms
};

} // namespace
NCVET_RULE(StyleUseSubprogram, style_use_subprogram)
} // namespace ncvet
