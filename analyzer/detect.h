// Detection: which control a program was most likely written for, by its name and its text.
#pragma once

#include "formats/dialect/loader.h"

#include "llvm/Support/Regex.h"

namespace ncvet {

struct Detection {
  std::string dialect; ///< id
  std::string reason;  ///< for --stats: what spoke for it
};

/// Endings of file names, in lower case, without the dot.
struct ProgramEndings {
  std::vector<std::string> sure;  ///< of part programs
  std::vector<std::string> loose; ///< of many things: the text decides; "" is no ending at all
};

/// Scores programs by the marks of the tables. Made once, then used by several threads.
class Detector {
public:
  /// Compiles the marks of all dialects that can be chosen: the built-in ones and `own`.
  static llvm::Expected<Detector> create(llvm::ArrayRef<DialectSummary> own = {});

  /// The dialect of a program, from its file name's ending and its first blocks.
  Detection detect(llvm::StringRef fileName, llvm::StringRef text) const;
  /// Endings that programs have in folders.
  const ProgramEndings &endings() const { return endings_; }

private:
  struct Mark {
    llvm::Regex pattern;
    llvm::SmallVector<uint64_t, 1> required; ///< sets of characters, one of which a line must hold
    /// (index of the dialect, score, reason): equal patterns are looked for once.
    struct Vote {
      size_t dialect;
      int score;
      std::string reason;
    };
    std::vector<Vote> votes;

    bool matches(llvm::ArrayRef<std::string> lines, llvm::ArrayRef<uint64_t> chars) const;
  };

  llvm::Error addDialects(std::vector<DialectSummary> dialects);

  std::vector<DialectSummary> dialects_; ///< those that are preferred first
  std::vector<Mark> marks_;
  ProgramEndings endings_;
  std::string fallback_;
  int minimumScore_ = 0;
};

/// Endings of part programs by the built-in tables, without compiling a mark.
llvm::Expected<ProgramEndings> programEndings();

/// True when the first lines of `text` are mostly blocks of words: a letter and a number.
bool looksLikeProgram(llvm::StringRef text);

} // namespace ncvet
