// Detection of the dialect: the marks of the tables, counted over the first blocks of a program.
#include "analyzer/setup/detect.h"

#include "formats/packed/shipped.h"
#include "formats/text/failure.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/Path.h"

namespace ncvet {

namespace {

/// What is looked at: enough to pass the header's comments and see a tool at work, little enough
/// for less than a millisecond.
constexpr size_t shownLines = 200;

/// An ending that one control alone has is as good as a mark, one of many says little.
constexpr int ownEnding = 5;
constexpr int sharedEnding = 1;

std::string endingOf(llvm::StringRef fileName) {
  return llvm::sys::path::extension(fileName).drop_while([](char c) { return c == '.'; }).lower();
}

/// The first lines in upper case, blanks at their ends dropped, empty ones left out.
std::vector<std::string> firstLines(llvm::StringRef text) {
  std::vector<std::string> lines;
  text.consume_front("\xEF\xBB\xBF");
  text = text.take_front(Detector::shownBytes);
  for (size_t line = 0; line < shownLines && !text.empty(); ++line) {
    const size_t end = std::min(text.find_first_of("\r\n"), text.size());
    // A `;` at a line's end is how some write the end of a block.
    const llvm::StringRef shown = text.take_front(end).ltrim(" \t").rtrim(" \t;");
    if (!shown.empty())
      lines.push_back(shown.upper());
    text = text.drop_front(end);
    if (!text.consume_front("\r\n"))
      text = text.drop_front(std::min<size_t>(1, text.size()));
  }
  return lines;
}

void addEndings(llvm::ArrayRef<DialectSummary> dialects, ProgramEndings &endings) {
  for (const DialectSummary &dialect : dialects)
    for (const std::string &ending : dialect.extensions)
      if (!llvm::is_contained(endings.sure, ending) && !llvm::is_contained(endings.loose, ending))
        endings.sure.push_back(ending);
}

llvm::Error checkMarks(llvm::ArrayRef<DialectSummary> dialects) {
  for (const DialectSummary &dialect : dialects)
    for (const DetectMark &mark : dialect.detect)
      if (llvm::Error wrong = PatternSet::check(mark.pattern))
        return failure("dialect " + dialect.id + ": " + llvm::toString(std::move(wrong)));
  return llvm::Error::success();
}

/// Line that begins with `(`, `;` or `%`, or an empty one: says nothing either way.
bool isRemark(llvm::StringRef line) {
  return line.empty() || llvm::StringRef("(;%:").contains(line.front());
}

/// `N10 G01 X5.` : a letter and a number, at least once, and nothing else before a comment.
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
  const DetectFile &table = shippedDetection();
  Detector detector;
  detector.fallback_ = table.fallback;
  detector.minimumScore_ = table.minimumScore;
  detector.sureScore_ = table.sureScore;
  detector.mostByHabits_ = table.mostByHabits;
  detector.endings_ = {table.extensions, table.looseExtensions};
  detector.unsure_ = {table.unsure.ignore, table.unsure.highest.value_or(Severity::Error),
                      table.unsure.toldOfOthers, table.unsure.differsInAlike};
  for (const auto &[name, marks] : table.otherControls)
    detector.others_.push_back({name, marks.readAs, marks.forMachine, marks.alike,
                                marks.highest.value_or(Severity::Error), marks.marks});
  std::vector<DialectSummary> dialects(own.begin(), own.end());
  for (const DialectSummary &known : shippedDialects())
    if (llvm::none_of(own, [&](const DialectSummary &mine) { return mine.id == known.id; }))
      dialects.push_back(known);
  llvm::erase_if(dialects, [](const DialectSummary &dialect) { return dialect.abstract; });
  addEndings(dialects, detector.endings_);
  const auto rank = [&](const DialectSummary &dialect) {
    return llvm::find(table.prefer, dialect.id) - table.prefer.begin();
  };
  llvm::stable_sort(dialects, [&](const DialectSummary &left, const DialectSummary &right) {
    return rank(left) < rank(right);
  });
  detector.dialects_ = std::move(dialects);
  for (size_t i = 0; i < detector.dialects_.size(); ++i)
    detector.addMarks(detector.dialects_[i].detect, i);
  for (size_t i = 0; i < detector.others_.size(); ++i)
    detector.addMarks(detector.others_[i].marks, detector.dialects_.size() + i);
  // Those that come with the program are known to be good.
  if (llvm::Error wrong = checkMarks(own))
    return wrong;
  if (!own.empty())
    if (llvm::Error wrong = detector.patterns_.compile())
      return wrong;
  for (const std::string &pattern : table.habits) {
    const auto mark = detector.markOfPattern_.find(pattern);
    if (mark == detector.markOfPattern_.end())
      return failure("detect.json: no mark has the pattern \"" + pattern + "\"");
    detector.marks_[mark->second].habit = true;
  }
  return detector;
}

void Detector::addMarks(llvm::ArrayRef<DetectMark> marks, size_t candidate) {
  for (const DetectMark &mark : marks) {
    const auto [known, isNew] = markOfPattern_.try_emplace(mark.pattern, marks_.size());
    if (isNew)
      marks_.resize(patterns_.add(mark.pattern) + 1);
    marks_[known->second].votes.push_back({candidate, mark.score, mark.reason});
  }
}

std::vector<Detector::Score> Detector::scores(llvm::StringRef fileName,
                                              llvm::StringRef text) const {
  const std::vector<bool> found = patterns_.inLines(firstLines(text));
  std::vector<Score> scores(dialects_.size() + others_.size());
  for (size_t mark = 0; mark < marks_.size(); ++mark)
    if (found[mark])
      for (const Mark::Vote &vote : marks_[mark].votes) {
        const bool habit = marks_[mark].habit && vote.score > 0;
        (habit ? scores[vote.candidate].habits : scores[vote.candidate].value) += vote.score;
        if (vote.score > 0)
          scores[vote.candidate].votes.push_back(&vote);
      }
  const std::string ending = endingOf(fileName);
  std::vector<size_t> claim;
  for (size_t index = 0; index < dialects_.size(); ++index)
    if (!ending.empty() && llvm::is_contained(dialects_[index].extensions, ending))
      claim.push_back(index);
  for (const size_t index : claim) {
    if (claim.size() == 1)
      scores[index].value += ownEnding;
    else
      scores[index].habits += sharedEnding;
    scores[index].ending = ending;
  }
  // What programmers of many controls write says little, however much of it there is.
  for (Score &score : scores)
    score.value += std::min(score.habits, mostByHabits_);
  return scores;
}

std::string Detector::Score::reason() const {
  auto strongest = votes;
  llvm::stable_sort(strongest, [](const Mark::Vote *left, const Mark::Vote *right) {
    return left->score > right->score;
  });
  std::string text;
  for (const Mark::Vote *vote : llvm::makeArrayRef(strongest).take_front(3))
    text += (text.empty() ? "" : "; ") + vote->reason;
  if (!ending.empty())
    text += (text.empty() ? "" : "; ") + ("ending ." + ending);
  return text;
}

Detection Detector::detect(llvm::StringRef fileName, llvm::StringRef text) const {
  const std::vector<Score> all = scores(fileName, text);
  const auto less = [](const Score &a, const Score &b) { return a.value < b.value; };
  // The first of equals: dialects that are preferred are first.
  const auto firstOther = all.begin() + ptrdiff_t(dialects_.size());
  const auto best = std::max_element(all.begin(), firstOther, less);
  const auto other = std::max_element(firstOther, all.end(), less);
  Detection found{fallback_, "nothing in it speaks for a control; read as the usual one"};
  if (best != firstOther && best->value >= minimumScore_)
    found = {dialects_[size_t(best - all.begin())].id, best->reason(), best->value >= sureScore_};
  // Lines for a simulator of the same language are no reason to doubt.
  for (size_t i = 0; i < others_.size(); ++i)
    if (others_[i].alike && !others_[i].forMachine &&
        all[dialects_.size() + i].value >= sureScore_) {
      found.other = others_[i].name;
      found.otherMarks = all[dialects_.size() + i].reason();
      found.otherIsAlike = found.otherIsNoMachine = true;
      found.reason += "; with lines for " + found.other;
      return found;
    }
  if (other == all.end() || other->value < sureScore_)
    return found;
  const OtherControl &without = others_[size_t(other - firstOther)];
  if (best != firstOther && other->value < best->value) {
    // The name of a machine in a comment weighs more than what several controls have.
    constexpr int clear = 8;
    const auto isName = [](const auto *vote) {
      return llvm::StringRef(vote->reason).startswith("a comment names");
    };
    if (found.sure && best->value - other->value < clear && llvm::any_of(other->votes, isName)) {
      found.reason += "; but " + other->reason() + " (" + without.name + ")";
      found.sure = false;
    }
    return found;
  }
  if (!without.readAs.empty())
    found.dialect = without.readAs;
  found.sure = false;
  found.other = without.name;
  found.otherMarks = other->reason();
  found.otherIsAlike = without.alike;
  found.otherIsNoMachine = !without.forMachine;
  found.otherHighest = without.highest;
  const std::string what = found.other + ": " + found.otherMarks;
  found.reason = (without.forMachine ? "written for a control without a table (" + what + ")"
                                     : "no program of a machine (" + what + ")") +
                 "; read as " + found.dialect;
  return found;
}

bool Detector::marks(llvm::StringRef other, llvm::StringRef line) const {
  const auto control =
      llvm::find_if(others_, [&](const OtherControl &c) { return c.name == other; });
  if (control == others_.end())
    return false;
  const size_t candidate = dialects_.size() + size_t(control - others_.begin());
  return llvm::any_of(patterns_.matching(line.trim(" \t").upper()), [&](int mark) {
    return llvm::any_of(marks_[size_t(mark)].votes,
                        [&](const Mark::Vote &vote) { return vote.candidate == candidate; });
  });
}

ProgramEndings Detector::builtinEndings() {
  const DetectFile &table = shippedDetection();
  ProgramEndings endings{table.extensions, table.looseExtensions};
  addEndings(shippedDialects(), endings);
  return endings;
}

bool looksLikeProgram(llvm::StringRef text) {
  unsigned words = 0, others = 0;
  for (const llvm::StringRef line : firstLines(text))
    if (!isRemark(line))
      ++(isWords(line) ? words : others);
  return words >= 2 && words >= 4 * others;
}

} // namespace ncvet
