// Detection of the dialect: the marks of the tables, counted over the first blocks of a program.
#include "analyzer/detect.h"

#include "analyzer/failure.h"
#include "formats/dialect/json_reader.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/Path.h"
#include <nlohmann/json.hpp>

#include <array>

namespace ncvet {

namespace {

/// What is looked at: enough to pass the header's comments and see a tool at work, little enough
/// for less than a millisecond.
constexpr size_t shownLines = 200;
constexpr size_t shownBytes = 16 * 1024;

/// An ending that one control alone has says more than one of many.
constexpr int ownEnding = 3;
constexpr int sharedEnding = 1;

struct Settings {
  std::string fallback;
  std::vector<std::string> prefer;
  int minimumScore = 0;
  ProgramEndings endings;
};

llvm::Expected<Settings> readSettings() {
  Settings settings;
  for (const RulesetFile &file : builtinRulesetFiles()) {
    if (file.name != "detect.json")
      continue;
    auto json = parseJson(file.name, file.text);
    if (!json)
      return json.takeError();
    const JsonLayer layer{file.name.str(), file.text};
    JsonReader in(layer, *json);
    in.allowKeys(
        *json, {"$schema", "fallback", "prefer", "minimumScore", "extensions", "looseExtensions"});
    in.read(*json, "fallback", settings.fallback);
    in.readWhole(*json, "minimumScore", settings.minimumScore, 0, 100);
    const auto list = [&](const char *key, std::vector<std::string> &target) {
      if (const Json *value = in.member(*json, key))
        target = in.texts(*value);
    };
    list("prefer", settings.prefer);
    list("extensions", settings.endings.sure);
    list("looseExtensions", settings.endings.loose);
    if (llvm::Error wrong = in.takeError())
      return wrong;
  }
  return settings;
}

std::string endingOf(llvm::StringRef fileName) {
  return llvm::sys::path::extension(fileName).drop_while([](char c) { return c == '.'; }).lower();
}

/// The first lines in upper case, blanks at their ends dropped, empty ones left out.
std::vector<std::string> firstLines(llvm::StringRef text) {
  std::vector<std::string> lines;
  text.consume_front("\xEF\xBB\xBF");
  text = text.take_front(shownBytes);
  for (size_t line = 0; line < shownLines && !text.empty(); ++line) {
    const size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const llvm::StringRef shown = text.take_front(end).trim(" \t");
    if (!shown.empty())
      lines.push_back(shown.upper());
    text = text.drop_front(end);
    if (!text.consume_front("\r\n"))
      text = text.drop_front(std::min<size_t>(1, text.size()));
  }
  return lines;
}

/// A bit for each character that programs are made of, 0 for all others.
constexpr std::array<uint64_t, 256> makeCharBits() {
  std::array<uint64_t, 256> bits{};
  uint64_t bit = 1;
  for (const char c : "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.,:;#%()[]=+-*/<>&'_") {
    bits[static_cast<unsigned char>(c)] = c ? bit : 0;
    bit <<= 1;
  }
  return bits;
}
constexpr std::array<uint64_t, 256> charBitTable = makeCharBits();

uint64_t charBit(char c) { return charBitTable[static_cast<unsigned char>(c)]; }

uint64_t charBits(llvm::StringRef text) {
  uint64_t bits = 0;
  for (const char c : text)
    bits |= charBit(c);
  return bits;
}

/// Characters that a line must hold for a pattern to match, one set for each alternative of the
/// pattern: most lines need no look at most patterns. Errs on the side of too few characters.
class RequiredChars {
public:
  explicit RequiredChars(llvm::StringRef pattern) : rest_(pattern) {
    uint64_t bits = 0;
    while (!rest_.empty()) {
      if (rest_.consume_front("|")) {
        alternatives_.push_back(bits);
        bits = 0;
        continue;
      }
      const uint64_t atom = readAtom();
      if (!isOptional())
        bits |= atom;
    }
    alternatives_.push_back(bits);
  }
  llvm::SmallVector<uint64_t, 1> take() { return std::move(alternatives_); }

private:
  /// The bit of a literal character; 0 for what may be one of several.
  uint64_t readAtom() {
    const char c = rest_.front();
    rest_ = rest_.drop_front();
    if (c == '\\' && !rest_.empty()) {
      const uint64_t bit = charBit(rest_.front());
      rest_ = rest_.drop_front();
      return bit;
    }
    if (c == '[') {
      const size_t end = rest_.find(']', 1); // a bracket that stands first is a member
      const uint64_t bit = end == 1 ? charBit(rest_.front()) : 0;
      rest_ = rest_.drop_front(std::min(rest_.size(), end + 1));
      return bit;
    }
    if (c == '(') {
      skipGroup();
      return 0;
    }
    return llvm::StringRef("^$.*+?{}").contains(c) ? 0 : charBit(c);
  }

  void skipGroup() {
    for (unsigned depth = 1; depth && !rest_.empty();) {
      const char c = rest_.front();
      size_t length = c == '\\' ? 2 : 1;
      if (c == '[')
        length = std::min(rest_.find(']', 2), rest_.size() - 1) + 1;
      depth += c == '(' ? 1 : 0;
      depth -= c == ')' ? 1 : 0;
      rest_ = rest_.drop_front(std::min(length, rest_.size()));
    }
  }

  bool isOptional() {
    bool optional = false;
    while (!rest_.empty() && llvm::StringRef("*+?{").contains(rest_.front())) {
      optional |= rest_.front() != '+';
      const size_t end = rest_.front() == '{' ? rest_.find('}') : 0;
      rest_ = rest_.drop_front(std::min(rest_.size(), end + 1));
    }
    return optional;
  }

  llvm::StringRef rest_;
  llvm::SmallVector<uint64_t, 1> alternatives_;
};

void addEndings(llvm::ArrayRef<DialectSummary> dialects, ProgramEndings &endings) {
  for (const DialectSummary &dialect : dialects)
    for (const std::string &ending : dialect.extensions)
      if (!llvm::is_contained(endings.sure, ending) && !llvm::is_contained(endings.loose, ending))
        endings.sure.push_back(ending);
}

/// Line that begins with `(`, `;` or `%`, or an empty one: says nothing either way.
bool isRemark(llvm::StringRef line) {
  return line.empty() || llvm::StringRef("(;%:").contains(line.front());
}

/// `N10 G01 X5.` : a letter and a number, at least once, and nothing else in front of a comment.
bool isWords(llvm::StringRef line) {
  line = line.take_until([](char c) { return c == '(' || c == ';'; });
  line.consume_front("/");
  bool any = false;
  while (!(line = line.ltrim(" \t,")).empty()) {
    if (!llvm::isAlpha(line.front()) && line.front() != '#')
      return false;
    const llvm::StringRef value = line.drop_front().ltrim(" ");
    const llvm::StringRef rest = value.drop_while(
        [](char c) { return llvm::isDigit(c) || llvm::StringRef("+-.#=[]*/").contains(c); });
    if (rest.size() == value.size())
      return false;
    line = rest;
    any = true;
  }
  return any;
}

} // namespace

llvm::Expected<Detector> Detector::create(llvm::ArrayRef<DialectSummary> own) {
  auto settings = readSettings();
  if (!settings)
    return settings.takeError();
  Detector detector;
  detector.fallback_ = settings->fallback;
  detector.minimumScore_ = settings->minimumScore;
  detector.endings_ = settings->endings;
  std::vector<DialectSummary> dialects(own.begin(), own.end());
  for (DialectSummary &known : listDialects())
    if (llvm::none_of(own, [&](const DialectSummary &mine) { return mine.id == known.id; }))
      dialects.push_back(std::move(known));
  llvm::erase_if(dialects, [](const DialectSummary &dialect) { return dialect.abstract; });
  addEndings(dialects, detector.endings_);
  const auto rank = [&](const DialectSummary &dialect) {
    return llvm::find(settings->prefer, dialect.id) - settings->prefer.begin();
  };
  llvm::stable_sort(dialects, [&](const DialectSummary &left, const DialectSummary &right) {
    return rank(left) < rank(right);
  });
  if (llvm::Error wrong = detector.addDialects(std::move(dialects)))
    return wrong;
  return detector;
}

bool Detector::Mark::matches(llvm::ArrayRef<std::string> lines,
                             llvm::ArrayRef<uint64_t> chars) const {
  for (size_t i = 0; i < lines.size(); ++i)
    if (llvm::any_of(required, [&](uint64_t bits) { return (chars[i] & bits) == bits; }) &&
        pattern.match(lines[i]))
      return true;
  return false;
}

llvm::Error Detector::addDialects(std::vector<DialectSummary> dialects) {
  dialects_ = std::move(dialects);
  llvm::StringMap<size_t> byPattern;
  for (size_t index = 0; index < dialects_.size(); ++index)
    for (const DetectMark &mark : dialects_[index].detect) {
      const auto [known, isNew] = byPattern.try_emplace(mark.pattern, marks_.size());
      if (isNew) {
        marks_.push_back({llvm::Regex(mark.pattern), RequiredChars(mark.pattern).take(), {}});
        std::string why;
        if (!marks_.back().pattern.isValid(why))
          return failure("dialect " + dialects_[index].id + ": pattern \"" + mark.pattern +
                         "\": " + why);
      }
      marks_[known->second].votes.push_back({index, mark.score, mark.reason});
    }
  return llvm::Error::success();
}

Detection Detector::detect(llvm::StringRef fileName, llvm::StringRef text) const {
  const std::vector<std::string> lines = firstLines(text);
  std::vector<uint64_t> chars;
  for (const std::string &line : lines)
    chars.push_back(charBits(line));
  std::vector<int> scores(dialects_.size());
  std::vector<std::vector<const Mark::Vote *>> reasons(dialects_.size());
  for (const Mark &mark : marks_)
    if (mark.matches(lines, chars))
      for (const Mark::Vote &vote : mark.votes) {
        scores[vote.dialect] += vote.score;
        if (vote.score > 0)
          reasons[vote.dialect].push_back(&vote);
      }
  const std::string ending = endingOf(fileName);
  std::vector<size_t> claim;
  for (size_t index = 0; index < dialects_.size(); ++index)
    if (!ending.empty() && llvm::is_contained(dialects_[index].extensions, ending))
      claim.push_back(index);
  for (const size_t index : claim)
    scores[index] += claim.size() == 1 ? ownEnding : sharedEnding;
  const auto best = std::max_element(
      scores.begin(), scores.end()); // the first of equals: those preferred stand first
  if (best == scores.end() || *best < minimumScore_)
    return {fallback_, "nothing in it speaks for a control; read as the usual one"};
  const size_t winner = size_t(best - scores.begin());
  llvm::stable_sort(reasons[winner], [](const Mark::Vote *left, const Mark::Vote *right) {
    return left->score > right->score;
  });
  Detection found{dialects_[winner].id, {}};
  for (const Mark::Vote *vote : llvm::makeArrayRef(reasons[winner]).take_front(3))
    found.reason += (found.reason.empty() ? "" : "; ") + vote->reason;
  if (llvm::is_contained(claim, winner))
    found.reason += (found.reason.empty() ? "" : "; ") + ("ending ." + ending);
  return found;
}

llvm::Expected<ProgramEndings> programEndings() {
  auto settings = readSettings();
  if (!settings)
    return settings.takeError();
  addEndings(listDialects(), settings->endings);
  return settings->endings;
}

bool looksLikeProgram(llvm::StringRef text) {
  unsigned words = 0, others = 0;
  for (const llvm::StringRef line : firstLines(text))
    if (!isRemark(line))
      ++(isWords(line) ? words : others);
  return words >= 2 && words >= 4 * others;
}

} // namespace ncvet
