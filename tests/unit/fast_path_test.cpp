// The short ways of reading, executing and telling blocks do what the long ones do.
#include "analyzer/flow/engine.h"
#include "analyzer/flow/known_blocks.h"
#include "analyzer/rule/hole_row.h"
#include "formats/readers/quick_reader.h"
#include "formats/readers/select/make_reader.h"
#include "formats/text/byte_search.h"
#include "lsp/features/same_block.h"
#include "tests/support/places.h"
#include "tests/support/rule_pages.h"
#include "tests/support/thorough.h"

#include <optional>
#include <random>

namespace ncvet::test {
namespace {

namespace fs = std::filesystem;

struct Sample {
  std::string dialect, name, text, machine;
};

std::string contentOf(const fs::path &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The control that a program of the corpus beside the project is taken for.
std::string dialectOf(const fs::path &path) {
  const std::string kind = path.extension().string(), folder = path.string();
  for (const char *family : {"/ecs/", "/mefi/", "/haas-lathe/", "/sinumerik/"})
    if (folder.find(family) != std::string::npos)
      return std::string(family).substr(1, std::string(family).size() - 2);
  if (kind == ".mpf" || kind == ".MPF" || kind == ".spf" || kind == ".SPF")
    return "sinumerik";
  return kind == ".ngc" ? "linuxcnc" : "fanuc-mill";
}

/// Not what is written about programs.
bool isProgram(const fs::path &path) {
  const std::string kind = path.extension().string();
  return kind != ".md" && kind != ".tsv" && kind != ".ini";
}

/// The golden programs, and those of the corpus beside the project when it is there: of that every
/// `step`th which is no longer than an editor's usual program.
std::vector<Sample> writtenPrograms(unsigned step) {
  std::vector<Sample> all;
  const fs::path own = places::sourceFolder() + "/tests/programs";
  for (const auto &file : fs::recursive_directory_iterator(own))
    if (file.is_regular_file() && file.path().extension() == ".nc") {
      const std::string folder = file.path().lexically_relative(own).begin()->string();
      all.push_back({folder == "examples" ? "haas-mill" : folder, file.path().string(),
                     contentOf(file.path()), ""});
    }
  constexpr uintmax_t longest = 30'000;
  const fs::path corpus = places::sourceFolder() + "/../shared/corpus";
  std::vector<fs::path> others;
  if (fs::is_directory(corpus))
    for (const auto &file : fs::recursive_directory_iterator(corpus))
      if (file.is_regular_file() && file.file_size() <= longest && isProgram(file.path()))
        others.push_back(file.path());
  std::sort(others.begin(), others.end());
  for (size_t i = 0; i < others.size(); i += step)
    all.push_back({dialectOf(others[i]), others[i].string(), contentOf(others[i]), ""});
  return all;
}

/// Blocks of a few spellings, again and again, with what may change their meaning between them.
std::string randomMilling(unsigned seed) {
  std::mt19937 dice(seed);
  const auto one = [&](std::initializer_list<const char *> list) {
    return std::string(list.begin()[dice() % list.size()]);
  };
  const auto number = [&] {
    const std::string whole = std::to_string(int(dice() % 200) - 100);
    return one({"", "", "", "0"}).empty() ? whole + "." + std::to_string(dice() % 1000) : whole;
  };
  std::string text = "%\nO1000\nG21 G17 G90 G94 G40 G49 G80\nT1 M6\nG54 S1000 M3\nG0 X0. Y0. Z5.\n"
                     "G1 Z-1. F200.\n";
  unsigned block = 10;
  for (unsigned piece = 0; piece < 40; ++piece) {
    const std::string code = one({"", "", "G1 ", "G01", "G0 ", "G90 G1 ", "G91 G1 ", "G1 G90 "});
    const bool numbered = dice() % 2, z = dice() % 3 == 0;
    const unsigned count = dice() % 8 + 1;
    for (unsigned i = 0; i < count; ++i) {
      if (dice() % 9 == 0)
        text +=
            one({"\n", "(NOTE)\n", "  ; NOTE\n", "( A ( B ) )\n", "(OPEN\n", " \t(A) (B) \r\n"});
      text += numbered ? "N" + std::to_string(block += 10) + one({" ", " ", ""}) : "";
      text += code + "X" + number() + one({" Y", "Y"}) + number() + (z ? " Z" + number() : "");
      text +=
          one({"", "", "", "", "", " F300.", " (C)", " S900", " M8"}) + one({"\n", "\n", " \n"});
    }
    text += one({"",
                 "",
                 "G0 Z5.\n",
                 "M5\n",
                 "S2000 M3\n",
                 "G41 D1 X1. Y1.\n",
                 "G40 X0.\n",
                 "G20\n",
                 "G21\n",
                 "G18\n",
                 "G17\n",
                 "T2 M6\n",
                 "G91\n",
                 "G90\n",
                 "G81 X1. Z-2. R1.\n",
                 "G80\n",
                 "/ X5.\n",
                 "G2 X1. Y1. R5.\n",
                 "G53 G0 Z0.\n",
                 "M98 P2000\n",
                 "F0\n",
                 "G95\n",
                 "G68 X0. Y0. R10.\n",
                 "G69\n",
                 "#1=3\n",
                 "X#1 Y2.\n",
                 "G52 X1.\n"});
  }
  text += "M30\nO2000\n";
  for (unsigned i = 0; i < 6; ++i)
    text += "G1 X" + number() + "\n";
  return text + "M99\n%\n";
}

/// A few spellings in turn, again and again, with other numbers each time, in modes that change
/// between them.
std::string randomRows(unsigned seed) {
  std::mt19937 dice(seed);
  const auto one = [&](std::initializer_list<const char *> list) {
    return std::string(list.begin()[dice() % list.size()]);
  };
  std::string text = "%\nO1000\nG21 G17 G90 G94 G40 G49 G80\nT1 M6\nG54 S1000 M3\nG0 X0. Y0. Z5.\n"
                     "G1 Z-1. F200.\n";
  for (unsigned piece = 0; piece < 12; ++piece) {
    text += one({"",
                 "G91\n",
                 "G90\n",
                 "G18\n",
                 "G17\n",
                 "G20\n",
                 "G21\n",
                 "G41 D1 X1. Y1.\n",
                 "G40 X0. Y0.\n",
                 "G98 G81 X1. Z-2. R1. F100.\n",
                 "G99 G73 X1. Z-5. R1. Q1.\n",
                 "G80\n",
                 "F77.\n",
                 "M5\n",
                 "S900 M3\n",
                 "G55\n",
                 "G53 G0 Z0.\n",
                 "T2 M6\n",
                 "G95\n",
                 "G68 X0. Y0. R10.\n",
                 "G69\n",
                 "G52 X1.\n",
                 "G0 Z5.\n",
                 "G16\n",
                 "G15\n",
                 "G84 R1.\n"});
    std::vector<std::string> spellings;
    for (unsigned i = dice() % 4 + 1; i > 0; --i)
      spellings.push_back(one({"X@ Y@",
                               "X@",
                               "Z@",
                               "G1 X@ Y@",
                               "G0 X@ Y@ Z@",
                               "G2 X@ Y@ R@",
                               "G3 X@ Y@ I@ J@",
                               "G2 I@",
                               "X@ Y@ (CORNER)",
                               "N7 G1 X@",
                               "G90 G94 G17 G1 X@ Y@ F200.",
                               "G91 X@",
                               "G49 X@ Z@",
                               "G54 G80 X@ Y@",
                               "G1 X@ Y@ S1000 M3 D2 F200.",
                               "G98 X@",
                               "U@",
                               "G1 X@ A@",
                               "X@ R@",
                               "G40 X@",
                               "G41 X@ Y@ D1",
                               "G18 G49 X@",
                               "M8 X@",
                               "G4 P@",
                               "X@ K@",
                               "G1 X@ ,R@"}));
    for (unsigned round = dice() % 6 + 2; round > 0; --round)
      for (const std::string &spelling : spellings) {
        for (const char c : spelling)
          text += c == '@' ? std::to_string(int(dice() % 200) - 100) + "." +
                                 std::to_string(dice() % 1000)
                           : std::string(1, c);
        text += "\n";
      }
  }
  return text + "M30\n%\n";
}

/// Such rows in programs that are called, one time or several, from the main program, from one
/// another and as macros.
std::string randomCalls(unsigned seed) {
  std::mt19937 dice(seed);
  const auto one = [&](std::initializer_list<const char *> list) {
    return std::string(list.begin()[dice() % list.size()]);
  };
  const auto rows = [&](unsigned number) {
    const std::string whole = randomRows(number);
    const size_t begin = whole.find("G0 X0.");
    return whole.substr(begin, whole.find("M30") - begin);
  };
  std::string text = "%\nO1000\nG21 G17 G90 G94 G40 G49 G80\nT1 M6\nG54 S1000 M3\nF200.\n";
  for (unsigned call = dice() % 8 + 2; call > 0; --call)
    text +=
        one({"M98 P2000\n", "M98 P2000\n", "M98 P3000\n", "M98 P2000 L2\n", "G65 P2000 A1.\n"}) +
        one({"", "", "G91\n", "G90\n", "G18\n", "G41 D1 X1. Y1.\n", "G40 X0.\n", "X5.\n"});
  return text + "M30\nO2000\n" + rows(seed) + "M99\nO3000\n" + rows(seed + 1) + "M98 P2000\n" +
         rows(seed) + "M99\n%\n";
}

std::vector<Sample> randomPrograms() {
  std::vector<Sample> all;
  for (unsigned seed = 0; seed < tried(15, 60); ++seed)
    for (const char *dialect : {"fanuc-0m", "haas-mill"})
      all.push_back({dialect, "calls " + std::to_string(seed), randomCalls(seed), ""});
  for (unsigned seed = 0; seed < tried(30, 120); ++seed)
    for (const char *dialect : {"fanuc-0m", "haas-mill", "nct-104m", "linuxcnc", "fanuc-mill"})
      if (seed % 5 == 0 || std::string(dialect) == "haas-mill")
        all.push_back({dialect, "random " + std::to_string(seed), randomMilling(seed), ""});
  for (unsigned seed = 0; seed < tried(50, 200); ++seed)
    for (const char *dialect :
         {"fanuc-0m", "haas-mill", "nct-104m", "linuxcnc", "sinumerik", "fanuc-0t"})
      if (seed % 4 == 0 || std::string(dialect) == "fanuc-0m")
        all.push_back({dialect, "rows " + std::to_string(seed), randomRows(seed), ""});
  return all;
}

bool isSame(const Block &a, const Block &b, llvm::StringRef text) {
  if (!lsp::sameBlock(a, text, b, text) || a.begin != b.begin || a.end != b.end ||
      a.next != b.next || a.addresses != b.addresses || a.repeated != b.repeated ||
      a.pointed != b.pointed || a.pointless != b.pointless || a.numberBegin != b.numberBegin ||
      a.numberEnd != b.numberEnd)
    return false;
  for (size_t i = 0; i < a.words.size(); ++i)
    if (a.words[i].offset != b.words[i].offset || a.words[i].length != b.words[i].length)
      return false;
  return true;
}

/// Every block is read over the one before it; how often that went.
unsigned readTwice(const Sample &sample) {
  const auto dialect = dialectNamed(sample.dialect);
  const auto made = makeReader(*dialect, sample.text);
  const auto *const reader = dynamic_cast<const QuickReader *>(made.get());
  if (!reader)
    return 0;
  Block block, pattern;
  unsigned alike = 0;
  uint32_t empty = 0; // up to here there is nothing
  for (uint32_t at = reader->first(); at < sample.text.size(); at = block.next) {
    const AddressMask free = at % 2 ? dialect->axisWords : ~AddressMask(0);
    const bool read = reader->isPattern(pattern) && reader->readAlike(at, free, pattern);
    reader->read(at, block);
    alike += read;
    if (read && !isSame(pattern, block, sample.text))
      ADD_FAILURE() << sample.name << " at " << at;
    const bool isEmpty = block.kind == BlockKind::Empty && block.issues.empty();
    if (at < empty && !isEmpty)
      ADD_FAILURE() << sample.name << ": passed over at " << at;
    if (at >= empty)
      empty = reader->emptyLines(at, uint32_t(sample.text.size())).end;
    if (!read) // else it is one that was read over another
      pattern = block;
  }
  return alike;
}

TEST(FastPath, ABlockReadOverTheOneBeforeItIsTheBlockThatTheReaderGives) {
  unsigned alike = 0;
  for (const Sample &sample : writtenPrograms(3))
    alike += readTwice(sample);
  for (const Sample &sample : randomPrograms())
    alike += readTwice(sample);
  EXPECT_GT(alike, 1000u);
}

/// A number as somebody may write it: of any width, with a sign, zeros, or without a point.
std::string randomNumber(std::mt19937 &dice) {
  std::string number = dice() % 4 ? "" : "-";
  number.append(dice() % 12 ? "" : "0");
  for (unsigned digits = dice() % 5 + (dice() % 20 ? 0 : 5); digits; --digits)
    number += char('0' + dice() % 10);
  if (dice() % 8)
    number += '.';
  for (unsigned digits = dice() % 5; digits; --digits)
    number += char('0' + dice() % 10);
  return number;
}

TEST(FastPath, NumbersOfOtherWidthsAreReadAsTheReaderReadsThem) {
  std::mt19937 dice(11);
  unsigned alike = 0;
  for (const char *dialect : {"fanuc-0m", "haas-mill", "sinumerik", "fanuc-0t"})
    for (unsigned turn = 0; turn < 40; ++turn) {
      const char *const ends[] = {"\n", "\r\n", " \n", " (A)\n"};
      const std::string gap = dice() % 4 ? " " : "", end = ends[turn % std::size(ends)];
      const bool hasNumbers = dice() % 3 == 0;
      Sample sample{dialect, "widths " + std::to_string(turn), "", ""};
      for (unsigned line = 0; line < 60; ++line) {
        if (hasNumbers)
          sample.text += "N" + std::to_string(1u << dice() % 27) + gap;
        sample.text += "G1" + gap + "X" + randomNumber(dice) + gap + "Z" + randomNumber(dice);
        sample.text += (dice() % 30 ? end : " F200." + end);
      }
      alike += readTwice(sample);
    }
  EXPECT_GT(alike, 1000u);
}

/// Blocks of known spellings; how many of them were looked at before their turn.
unsigned lookedAtBefore(const Sample &sample) {
  const auto dialect = dialectNamed(sample.dialect);
  const auto made = makeReader(*dialect, sample.text);
  const auto *const reader = dynamic_cast<const QuickReader *>(made.get());
  if (!reader)
    return 0;
  KnownBlocks known(*reader, dialect->axisWords);
  Block own, expected;
  unsigned looks = 0;
  for (uint32_t at = reader->first(), next = 0; at < sample.text.size(); at = next) {
    const KnownBlocks::Spelling *const spelling = known.read(at);
    reader->read(at, expected);
    next = expected.next;
    if (spelling && !isSame(spelling->block, expected, sample.text))
      ADD_FAILURE() << sample.name << " at " << at;
    if (!spelling) {
      own = expected;
      known.find(own);
    }
    const Block *const ahead = at % 3 ? known.peek(next) : nullptr;
    looks += ahead != nullptr;
    if (ahead && next < sample.text.size())
      reader->read(next, expected);
    if (ahead && !isSame(*ahead, expected, sample.text))
      ADD_FAILURE() << sample.name << ": looked at " << next;
  }
  return looks;
}

TEST(FastPath, ABlockThatIsLookedAtBeforeItsTurnIsTheBlockThatTheReaderGives) {
  unsigned looks = 0;
  for (const Sample &sample : writtenPrograms(3))
    looks += lookedAtBefore(sample);
  for (const Sample &sample : randomPrograms())
    looks += lookedAtBefore(sample);
  EXPECT_GT(looks, 1000u);
}

TEST(FastPath, BytesAreFoundWhereALookAtEachOfThemFindsThem) {
  std::mt19937 dice(7);
  std::string text(300, ' ');
  for (unsigned turn = 0; turn < 2000; ++turn) {
    for (char &c : text)
      c = dice() % 40 == 0 ? "()\n\r"[dice() % 4] : char('A' + dice() % 26);
    const char *const begin = text.data() + dice() % 40, *const end = begin + dice() % 200;
    EXPECT_EQ(findAny(begin, end, '(', ')', '\n', '\r'),
              findAnyBytewise(begin, end, '(', ')', '\n', '\r'));
  }
}

/// What happens in a run, as one text.
class Diary : public FlowListener {
public:
  FlowInterest interest() const override { return {~0u, true, true, false}; }
  void executed(const Step &step, bool) override {
    text += std::to_string(step.at) + ":" + std::to_string(step.block.number);
    for (const Event &event : step.outcome.events)
      text += " " + std::to_string(unsigned(event.kind)) + "," +
              std::to_string(unsigned(event.motion)) + "," + std::to_string(event.axes) + "," +
              std::to_string(event.code) + "," +
              std::to_string(event.word ? event.word->offset : 0);
    for (const MachineState *state :
         {&step.before, static_cast<const MachineState *>(&*step.live.state)})
      text += " " + std::to_string(hash(*state));
    uint64_t places = 0;
    for (const Origin &origin : step.live.state->origin.all())
      places = places * 31 + origin.begin * 7 + origin.end;
    text += " " + std::to_string(places) + "\n";
  }
  bool executedAgain(const Step &step) override {
    executed(step, false);
    return true;
  }

  std::string text;
};

std::string diaryOf(Project &project, FileUnit &unit, bool inFull) {
  AnalysisLimits limits;
  limits.repeatedBlocks = 10'000; // loops without an end are no use here
  Engine engine(project, unit, limits, nullptr);
  engine.inFull = inFull;
  Diary diary;
  engine.listen(diary);
  engine.run();
  return diary.text + std::to_string(engine.blockCount()) + " " +
         std::to_string(engine.isComplete());
}

/// Nothing where the budget cuts the program short: what rules cost counts, too, and where they are
/// told all of it is spent some blocks earlier.
std::optional<std::string> findingsOf(Project &project, FileUnit &unit, bool inFull) {
  AnalysisLimits limits;
  limits.repeatedBlocks = 10'000; // loops without an end are no use here
  RuleSelection all = RuleSelection::defaults(*unit.dialect);
  std::fill(all.enabled.begin(), all.enabled.end(), true);
  Engine engine(project, unit, limits, nullptr);
  engine.inFull = inFull;
  RuleHost host(unit, all, limits, engine.visits);
  if (inFull)
    host.tellInFull();
  engine.listen(host);
  engine.run();
  if (!engine.isComplete())
    return std::nullopt;
  std::string text;
  for (const Finding &finding : host.take(project.sources())) {
    text += std::to_string(finding.range.begin) + "-" + std::to_string(finding.range.end) + " " +
            allRules()[finding.rule].info.id.str() + " " + finding.message;
    for (const Note &note : finding.notes)
      text += " | " + std::to_string(note.range.begin) + " " + note.message;
    text += "\n";
  }
  return text;
}

/// The first line that differs.
std::string difference(const std::string &a, const std::string &b) {
  size_t line = 0;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i] != b[i])
      break;
    line = a[i] == '\n' ? i + 1 : line;
  }
  return a.substr(line, a.find('\n', line) - line) + "\n" +
         b.substr(line, b.find('\n', line) - line);
}

void compare(const Sample &sample) {
  withProgram(sample.dialect, {{"part.nc", sample.text}}, sample.machine,
              [&](Project &project, FileUnit &unit) {
                const std::string whole = diaryOf(project, unit, true);
                const std::string brief = diaryOf(project, unit, false);
                EXPECT_TRUE(whole == brief) << sample.dialect << " " << sample.name << "\n"
                                            << difference(whole, brief);
                const std::optional all = findingsOf(project, unit, true);
                const std::optional found = findingsOf(project, unit, false);
                if (all && found) {
                  EXPECT_TRUE(*all == *found) << sample.dialect << " " << sample.name << "\n"
                                              << difference(*all, *found);
                }
              });
}

/// Rows of holes, some of which are made twice, and what may come between them.
std::string randomHoles(unsigned seed) {
  std::mt19937 dice(seed);
  const auto one = [&](std::initializer_list<const char *> list) {
    return std::string(list.begin()[dice() % list.size()]);
  };
  std::string text = "%\nO1000\nG21 G17 G90 G94 G40 G49 G80\nT1 M6\nG54 S1000 M3\nG43 H1 Z50.\n";
  unsigned number = 10;
  for (unsigned row = 0; row < 14; ++row) {
    text += one({"G98 G81 X0. Y0. Z-6.5 R2. F180.\n", "G99 G83 X1. Y1. Z-9. R1. Q2. F90.\n",
                 "G82 Z-4. R2. P100\n", "G98 G81 X0. Y0. Z-6.5 R2. F180.\n"});
    const bool hasNumbers = dice() % 4 == 0, repeats = dice() % 3 == 0;
    double x = 0, y = 0;
    for (unsigned hole = dice() % 120; hole; --hole) {
      const bool both = dice() % 8 == 0;
      x = both && dice() % 2 ? 0 : x + 9.5;
      y += both ? 8.25 : 0;
      if (repeats && dice() % 20 == 0)
        x = 9.5;
      text += hasNumbers ? "N" + std::to_string(number += 10) + " " : "";
      text += "X" + std::to_string(x).substr(0, std::to_string(x).find('.') + 3);
      text += both ? " Y" + std::to_string(y).substr(0, std::to_string(y).find('.') + 4) : "";
      text += dice() % 40 ? "\n"
                          : one({" (HOLE)\n", " Z-7.\n", " R3.\n", "\n(NEXT)\n", " F99.\n",
                                 "\nG99\n", " \n", "\nG91 X5.\nG90\n"});
    }
    text += one({"G80\n", "G80\nG0 Z50.\nX9.5 Y0.\n", "G0 X1.\n", "G80\nT2 M6\nG43 H2 Z50.\n",
                 "G55\n", "M98 P2000\n", "G80\nG1 X3. Y3. F100.\nG1 Z-1.\nX9.\n"});
  }
  return text + "G80\nM30\nO2000\nX3.\nX4.\nX3.\nM99\n%\n";
}

/// Is told of rows together.
class RowDiary final : public Diary {
public:
  explicit RowDiary(unsigned share) : share_(share) {}
  size_t executedRow(const Step &, const HoleRow &, size_t most) override {
    const size_t taken = share_ ? most * (turn_++ % share_) / share_ : most;
    together += taken;
    return taken;
  }

  size_t together = 0;

private:
  unsigned share_, turn_ = 0;
};

/// What is told of a hole that comes after some that were told together is what is told of it where
/// all are told one by one; how many were told together.
size_t toldTogether(const Sample &sample, unsigned share) {
  size_t together = 0;
  withProgram(
      sample.dialect, {{"part.nc", sample.text}}, "", [&](Project &project, FileUnit &unit) {
        const std::string whole = diaryOf(project, unit, true);
        const AnalysisLimits limits; // the engine only looks at it
        Engine engine(project, unit, limits, nullptr);
        RowDiary diary(share);
        engine.listen(diary);
        engine.run();
        together = diary.together;
        llvm::StringRef rest = whole;
        for (llvm::StringRef left = diary.text; !left.empty();) {
          const auto [line, after] = left.split('\n');
          const size_t at = rest.find((line + "\n").str());
          if (at == llvm::StringRef::npos) {
            ADD_FAILURE() << sample.name << ": " << line.str();
            break;
          }
          rest = rest.drop_front(at);
          left = after;
        }
        EXPECT_EQ(whole.substr(whole.rfind('\n') + 1),
                  std::to_string(engine.blockCount()) + " " + std::to_string(engine.isComplete()));
      });
  return together;
}

TEST(FastPath, HolesThatAreToldTogetherLeaveTheStateThatTheyLeaveOneByOne) {
  size_t together = 0;
  for (unsigned seed = 0; seed < tried(20, 100); ++seed)
    for (const char *dialect : {"fanuc-0m", "haas-mill", "linuxcnc"}) {
      const Sample sample{dialect, "holes " + std::to_string(seed), randomHoles(seed), ""};
      together += toldTogether(sample, seed % 4);
      compare(sample);
    }
  EXPECT_GT(together, 1000u);
}

TEST(FastPath, ListenersAreToldTheSameAndTheSameIsFoundInRandomPrograms) {
  for (const Sample &sample : randomPrograms())
    compare(sample);
}

/// Loops in which statements, moves and calls come round with other numbers, and sometimes in other
/// modes.
std::vector<Sample> randomLoops() {
  const std::vector<std::string> macro{"#105=#105*0.5",
                                       "#106=3.*SIN[#105*4.]-#101",
                                       "IF [#106 GT 1.] THEN #106=1.",
                                       "IF [#101 EQ 3] GOTO 50",
                                       "G65 P2 Z#106 A#101",
                                       "G65 P2 Z1. A2.",
                                       "M98 P3",
                                       "G1 X#105 Y#106 Z-#101 F[100+#101]",
                                       "G1 X1. Y2. F200.",
                                       "G0 Z#105",
                                       "G91",
                                       "G90",
                                       "G41 D1 X#101",
                                       "G40 X#101",
                                       "F#106",
                                       "S[1000*#101] M3",
                                       "M5",
                                       "G[17+#103]",
                                       "T#101 M6",
                                       "/#107=#107+1",
                                       "#[110+#101]=#0",
                                       "G81 X#101 Z-2. R1.",
                                       "X#105 (HOLE)",
                                       "G80"};
  const std::vector<std::string> structured{"R5=R5*0.5",
                                            "R6=3*SIN(R5*4)-R1",
                                            "IF R6>1 R6=1 ENDIF",
                                            "IF R6>1",
                                            "G1 X=R5 Y=R6 Z=-R1 F=100+R1",
                                            "ELSE",
                                            "G0 Z=R5",
                                            "ENDIF",
                                            "G91",
                                            "G90",
                                            "S=1000*R1 M3",
                                            "M5",
                                            "FOR R8=1 TO 3",
                                            "R9=R9+R8",
                                            "X=R9",
                                            "ENDFOR",
                                            "G41 X=R1",
                                            "G40 X=R1"};
  const std::vector<std::string> bracketed{"#2=[#2*0.5+1]",
                                           "#<depth>=[0-#1]",
                                           "o2 if [#1 GT 4]",
                                           "G1 X#2 Y[#1*2] Z#<depth> F200",
                                           "o2 else",
                                           "G0 Z[5+#<depth>]",
                                           "o2 endif",
                                           "o3 repeat [2]",
                                           "G91 X#2",
                                           "o3 endrepeat",
                                           "G90",
                                           "o9 call [#1] [#2]",
                                           "G2 X#1 Y0 R[10+#1]",
                                           "#4=[1/[#1-5]]",
                                           "G81 X#1 Z-2 R1",
                                           "X#2",
                                           "G80",
                                           "X#5420 Y#5221"};
  std::mt19937 dice(11);
  std::vector<Sample> samples;
  for (unsigned turn = 0; turn < 90; ++turn) {
    const bool isMacro = turn % 3, isBracketed = turn % 6 == 3;
    const std::vector<std::string> &lines = isMacro ? macro : isBracketed ? bracketed : structured;
    std::string text =
        isMacro       ? "%\nO1\nG21 G17 G90 G94 G54 G49 G80 G40\nT1 M6\nG43 H1 Z50.\n#101=0\n"
                        "WHILE [#101 LT 12] DO 1\n"
        : isBracketed ? "o9 sub\n#3=[#1+#2]\nG1 X#3 F100\no9 endsub\nG21 G17 G90 G94 G54 G40\n"
                        "T1 M6\nG43 H1 Z50\nF100\n#1=0\n#2=1\no1 while [#1 LT 12]\n"
                      : "G71 G17 G90 G94 G54\nT1 M6 D1\nR1=0\nWHILE R1<12\n";
    const size_t first = dice() % lines.size(), count = 3 + dice() % 9;
    for (size_t i = 0; i < count; ++i)
      text += lines[isMacro ? dice() % lines.size() : (first + i) % lines.size()] + "\n";
    text += isMacro       ? "N50 #101=#101+1\nEND 1\nM30\nO2\n#1=#26-0.1\n#105=#1+0.05\n"
                            "IF [#1 LT 0] GOTO 9\nG1 Z#1\nN9 M99\nO3\n#107=#107+1\nX#107\nM99\n%\n"
            : isBracketed ? "#1=[#1+1]\no1 endwhile\nM2\n"
                          : "R1=R1+1\nENDWHILE\nM30\n";
    const std::string control = isMacro       ? turn % 2 ? "haas-mill" : "fanuc-mill"
                                : isBracketed ? "linuxcnc"
                                              : "sinumerik";
    samples.push_back({control, "loop " + std::to_string(turn), text, ""});
  }
  return samples;
}

TEST(FastPath, ListenersAreToldTheSameAndTheSameIsFoundInRandomLoops) {
  for (const Sample &sample : randomLoops())
    compare(sample);
}

TEST(FastPath, EmptyLinesAfterMovesAreNoMoves) {
  std::string moves = "G21 G90 G54\n";
  for (int i = 1; i <= 6; ++i)
    moves += "G0 X" + std::to_string(i) + ".5 Y" + std::to_string(i) + ".25\n";
  for (const char *dialect : {"linuxcnc", "haas-mill", "fanuc-0m", "sinumerik"})
    for (const char *between : {"\n", "\n\n", "(A)\n(B)\n", "\n\nG0 X1. Y2.\n\n\n"})
      compare({dialect, "moves, then empty lines", moves + between + "G0 Z50.\nM2\n", ""});
}

TEST(FastPath, ListenersAreToldTheSameAndTheSameIsFoundInWrittenPrograms) {
  for (const Sample &sample : writtenPrograms(9))
    compare(sample);
}

TEST(FastPath, ListenersAreToldTheSameAndTheSameIsFoundInThePagesOfTheRules) {
  unsigned count = 0;
  for (const RuleEntry &rule : allRules())
    for (const PageProgram &program : programsOf(rule.info))
      if (program.files.size() == 1 && program.problem.empty() && ++count % 7 == 0)
        compare({program.dialect, program.name(), program.files[0].text, program.machine});
}

/// The block with a statement that does nothing: it goes through all of the work.
Block inFull(const Block &block) {
  Block full = block;
  if (!full.items.empty())
    return full;
  Item item;
  item.kind = ItemKind::Output;
  item.begin = item.end = block.end;
  full.items.push_back(item);
  return full;
}

/// An event in which only what others see counts.
std::string described(const Event &event) {
  return std::to_string(unsigned(event.kind)) + "," + std::to_string(event.code) + "," +
         std::to_string(unsigned(event.motion)) + "," + std::to_string(event.axes) + "," +
         std::to_string(event.certain) + "," + std::to_string(event.word ? event.word->offset : 0);
}

std::string described(const Outcome &outcome) {
  std::string text;
  for (const Event &event : outcome.events)
    if (event.kind != EventKind::Statement)
      text += described(event) + " ";
  return text;
}

/// Executes the blocks of numbers from the begin of the text to its end, whatever its flow, with
/// and without short ways.
void executeTwice(const Sample &sample) {
  withProgram(sample.dialect, {{"part.nc", sample.text}}, sample.machine,
              [&](Project &, FileUnit &unit) {
                MachineState a = initialState(*unit.dialect), b = a;
                Outcome brief, whole;
                Block block;
                const auto size = uint32_t(unit.source.text().size());
                for (uint32_t at = unit.reader->first(); at < size; at = block.next) {
                  unit.reader->read(at, block);
                  if (!block.items.empty() || !block.expressions.empty() || !block.issues.empty() ||
                      block.isEmpty())
                    continue;
                  const Block full = inFull(block);
                  const MachineState beforeA = a, beforeB = b;
                  unit.executor().execute(block, beforeA, a, brief);
                  unit.executor().execute(full, beforeB, b, whole);
                  ASSERT_TRUE(equal(a, b) && a.origin.all() == b.origin.all())
                      << sample.dialect << " " << sample.name << "\n"
                      << unit.source.text().slice(at, block.end).str();
                  ASSERT_EQ(described(brief), described(whole))
                      << sample.dialect << " " << sample.name << "\n"
                      << unit.source.text().slice(at, block.end).str();
                }
              });
}

TEST(FastPath, APlainMoveDoesWhatExecutingItInFullDoes) {
  for (const Sample &sample : randomPrograms())
    executeTwice(sample);
  for (const Sample &sample : writtenPrograms(3))
    executeTwice(sample);
}

} // namespace
} // namespace ncvet::test
