// Detection: which control a program was most likely written for, by its name and its text.
#pragma once

#include "analyzer/setup/pattern_set.h"
#include "formats/dialect/loader.h"

namespace ncvet {

struct Detection {
  std::string dialect; ///< id
  std::string reason;  ///< for --stats: what spoke for it
  /// False when little speaks for the dialect, or more for a control without a table: what rests on
  /// facts of the control alone should not be reported.
  bool sure = false;
  /// The control without a table that the text is for, and the evidence; empty: none.
  std::string other = {}, otherMarks = {};
  bool otherIsAlike = false;     ///< its language is nearly that of the dialect
  bool otherIsNoMachine = false; ///< no machine runs such a text
  Severity otherHighest = Severity::Error;
};

/// What is reported of a program whose control is not known for sure.
struct UnsureReports {
  std::vector<std::string> ignore; ///< rules and categories that rest on facts of the control
  Severity highest = Severity::Error;
  /// Categories, see `UnsureFile`.
  std::vector<std::string> toldOfOthers, differsInAlike;
};

/// Endings of file names, in lower case, without the dot.
struct ProgramEndings {
  std::vector<std::string> sure;  ///< of part programs
  std::vector<std::string> loose; ///< of many things: the text decides; "" is no ending at all
};

/// Scores programs by the marks of the tables. Made once, then used by several threads.
class Detector {
public:
  /// Takes the marks of all dialects that can be chosen: the built-in ones and `own`.
  static llvm::Expected<Detector> create(llvm::ArrayRef<DialectSummary> own = {});

  /// Endings of part programs by the built-in tables, without compiling a mark.
  static ProgramEndings builtinEndings();
  /// Bytes of a text that are looked at.
  static constexpr size_t shownBytes = 16 * 1024;
  /// The dialect of a program, from its file name's ending and its first blocks.
  Detection detect(llvm::StringRef fileName, llvm::StringRef text) const;
  /// Whether a line bears a mark of a control without a table: that control can read it.
  bool marks(llvm::StringRef other, llvm::StringRef line) const;
  /// Endings that programs have in folders.
  const ProgramEndings &endings() const { return endings_; }
  const UnsureReports &unsure() const { return unsure_; }
  /// Whether findings of a category say something of a text for a control without a table.
  bool isTold(llvm::StringRef category, bool alike) const {
    return llvm::is_contained(unsure_.toldOfOthers, category) ||
           (alike && !llvm::is_contained(unsure_.differsInAlike, category));
  }

private:
  struct Mark {
    /// (index of the candidate, score, reason): equal patterns are looked for once.
    struct Vote {
      size_t candidate;
      int score;
      std::string reason;
    };
    std::vector<Vote> votes;
    bool habit = false; ///< programs for several controls have it
  };

  /// What speaks for a candidate.
  struct Score {
    int value = 0;
    int habits = 0; ///< of marks that programs for several controls have; in `value` up to a limit
    std::vector<const Mark::Vote *> votes;
    std::string ending; ///< of the file's name, when it is one of the candidate's

    std::string reason() const;
  };
  /// A control without a table: its marks only say that no table fits.
  struct OtherControl {
    std::string name;
    std::string readAs; ///< id of the nearest dialect; empty: the one that the text speaks for
    bool forMachine, alike;
    Severity highest;
    std::vector<DetectMark> marks;
  };
  std::vector<Score> scores(llvm::StringRef fileName, llvm::StringRef text) const;
  void addMarks(llvm::ArrayRef<DetectMark> marks, size_t candidate);

  /// Candidates are the dialects, those that are preferred first, then the other controls.
  std::vector<DialectSummary> dialects_;
  std::vector<OtherControl> others_;
  PatternSet patterns_;
  std::vector<Mark> marks_; ///< by the number of the pattern
  llvm::StringMap<size_t> markOfPattern_;
  ProgramEndings endings_;
  UnsureReports unsure_;
  std::string fallback_;
  int minimumScore_ = 0, sureScore_ = 0, mostByHabits_ = 0;
};

/// True when the first lines of `text` are mostly blocks of words: a letter and a number.
bool looksLikeProgram(llvm::StringRef text);

} // namespace ncvet
