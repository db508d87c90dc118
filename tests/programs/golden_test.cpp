// Golden programs: every finding of the recommended rules is marked in the program, and no other.
#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"

namespace ncvet::test {
namespace {

namespace fs = std::filesystem;

struct Golden {
  std::string dialect;
  fs::path path;

  std::string name() const {
    std::string text = dialect + "_" + path.stem().string();
    std::replace_if(
        text.begin(), text.end(), [](char c) { return !isalnum(uint8_t(c)); }, '_');
    return text;
  }
};

void PrintTo(const Golden &golden, std::ostream *out) { *out << golden.name(); }

/// tests/programs/<dialect>/*.nc; other files there are called programs, or belong to a golden one.
std::vector<Golden> goldenPrograms() {
  std::vector<Golden> all;
  for (const auto &folder : fs::directory_iterator(places::sourceFolder() + "/tests/programs")) {
    const std::string dialect = folder.path().filename().string();
    if (!folder.is_directory() || dialect == "examples")
      continue;
    for (const auto &file : fs::directory_iterator(folder.path()))
      if (file.path().extension() == ".nc")
        all.push_back({dialect, file.path()});
  }
  std::sort(all.begin(), all.end(),
            [](const Golden &a, const Golden &b) { return a.path < b.path; });
  return all;
}

std::string readFile(const fs::path &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The program with the other numbered programs of its folder, which it may call.
std::vector<ProgramFile> filesOf(const Golden &golden, std::string text) {
  std::vector<ProgramFile> files{{golden.path.filename().string(), std::move(text)}};
  std::vector<fs::path> others;
  const fs::path called = golden.path.parent_path() / "called";
  if (fs::is_directory(called))
    for (const auto &file : fs::directory_iterator(called))
      others.push_back(file.path());
  std::sort(others.begin(), others.end());
  for (const fs::path &other : others)
    files.push_back({other.filename().string(), readFile(other)});
  return files;
}

std::string machineOf(const Golden &golden) {
  fs::path machine = golden.path;
  machine.replace_extension(".machine.json");
  return fs::exists(machine) ? readFile(machine) : "";
}

/// Letters whose words name block numbers in a block with these codes.
AddressMask sequenceWords(const Dialect &dialect, const Block &block) {
  AddressMask mask = 0;
  const auto add = [&](const CodeInfo &code) {
    for (const WordSpec &spec : code.words)
      if (spec.role == Role::ProfileFirst || spec.role == Role::ProfileLast ||
          spec.role == Role::Sequence)
        mask |= spec.any;
  };
  for (const Word &word : block.words) {
    if (word.address != letterAddress('G') && word.address != letterAddress('M'))
      continue;
    const CodeIndex index = dialect.find(char('A' + word.address), word.codeNumber());
    if (index == noCode)
      continue;
    add(dialect.codes[index]);
    for (const Variant &variant : dialect.codes[index].variants)
      add(dialect.codes[variant.code]);
  }
  return mask;
}

/// The same program with other block numbers (each 500 higher, targets too) and a blank before
/// every word: nothing that a control looks at has changed, and every block is in its line.
std::string renumberedAndRespaced(const std::string &dialectId, const std::string &text) {
  const auto dialect = dialectNamed(dialectId);
  const auto source = SourceFile::fromText(0, "golden.nc", text);
  const auto reader = makeReader(*dialect, source->text());
  std::vector<TextEdit> edits;
  const auto replace = [&](uint32_t begin, uint32_t end, std::string by) {
    edits.push_back({{0, begin, end}, std::move(by)});
  };
  Block block;
  for (uint32_t at = reader->first(); at < text.size(); at = block.next) {
    reader->read(at, block);
    if (block.number >= 0)
      replace(block.numberBegin, block.numberEnd, "N" + std::to_string(block.number + 500));
    const AddressMask sequence = sequenceWords(*dialect, block);
    bool first = block.number < 0 && block.program < 0 && block.skip < 0;
    for (const Word &word : block.words) {
      const bool target = sequence & maskOf(word.address) && word.isNumber() && word.isWhole();
      if (target)
        replace(word.offset, block.endOf(word),
                (first ? "" : " ") + text.substr(word.offset, 1) +
                    std::to_string(word.mantissa + 500));
      else if (!first)
        replace(word.offset, word.offset, " ");
      first = false;
    }
    for (const Item &item : block.items)
      if (item.kind == ItemKind::Jump && item.value != noExpression &&
          block.expressions[item.value].count == 1) {
        const Expression &value = block.expressions[item.value];
        const ExpressionOp &op = block.operations[value.first];
        if (op.op == Op::Number)
          replace(value.begin, value.end, " " + std::to_string(int64_t(op.value) + 500));
      }
  }
  return applyEdits(text, edits);
}

class GoldenProgram : public ::testing::TestWithParam<Golden> {};

TEST_P(GoldenProgram, HasExactlyTheFindingsThatItMarks) {
  const Golden &golden = GetParam();
  const std::string text = readFile(golden.path);
  const auto found = analyseProgram(golden.dialect, filesOf(golden, text), machineOf(golden),
                                    RuleSelection::defaults);
  expectSame(marksOf(text), found, golden.path.filename().string());
}

TEST_P(GoldenProgram, HasTheSameFindingsWhenItIsRenumberedAndRespaced) {
  const Golden &golden = GetParam();
  const std::string text = readFile(golden.path);
  const std::string other = renumberedAndRespaced(golden.dialect, text);
  ASSERT_NE(text, other);
  const auto found = analyseProgram(golden.dialect, filesOf(golden, other), machineOf(golden),
                                    RuleSelection::defaults);
  // Columns have moved: line, rule and certainty are what stays.
  const auto linewise = [](std::vector<Seen> seen) {
    for (Seen &entry : seen)
      entry.column = entry.endColumn = 0;
    return seen;
  };
  expectSame(linewise(marksOf(text)), linewise(found), golden.path.filename().string());
}

INSTANTIATE_TEST_SUITE_P(Programs, GoldenProgram, ::testing::ValuesIn(goldenPrograms()),
                         [](const auto &info) { return info.param.name(); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(GoldenProgram);

} // namespace
} // namespace ncvet::test
