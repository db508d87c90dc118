// Reports: what a run has to say, and the interface of those who write it.
#pragma once

#include "formats/finding/finding.h"
#include "formats/reports/program_view.h"
#include "formats/text/source_set.h"

#include "llvm/Support/raw_ostream.h"

#include <string>
#include <tuple>
#include <vector>

namespace ncvet {

/// What became of one input file.
struct FileReport {
  std::string path;    ///< as shown in the findings
  std::string dialect; ///< id of the dialect it was read in
  uint64_t blocks = 0;
  bool complete = true; ///< false: the analysis was cut short, findings may be missing
  std::string detail;   ///< why this dialect
  bool guessed = false; ///< the dialect was found out, nobody named it
  bool sure = false;    ///< of the guess
};

/// Something about the run itself, such as a file that cannot be read. That an analysis was cut
/// short is said by `FileReport::complete` and needs no notification.
struct Notification {
  Severity severity = Severity::Warning;
  std::string message;
  std::string path; ///< empty when it is about no file
};

/// A finding of the baseline that the run did not make any more.
struct AbsentFinding {
  std::string rule; ///< id
  std::string path;
  std::string message;
  uint32_t line = 1;
  uint64_t fingerprint = 0;
};

/// All of one run. Nothing in it depends on time, place or order of work: the same input gives the
/// same bytes.
struct Report {
  std::string toolName = "ncvet";
  std::string toolVersion;
  std::string toolUri; ///< absolute URI of the tool's page; empty when there is none
  /// The folder that paths are relative to, as seen from the root of the project; empty: it is the
  /// root.
  std::string folder;
  std::string here; ///< the same folder as an absolute path, of which absolute paths are freed
  llvm::ArrayRef<RuleInfo> rules;
  const SourceSet *sources = nullptr;
  std::vector<Finding> findings;
  std::vector<FileReport> files;
  std::vector<Notification> notifications;
  bool baselineUsed = false;
  std::vector<AbsentFinding> absent;
  /// Of formats that show programs (`ReportFormat::showsPrograms`); in the order of `files`.
  std::vector<ProgramView> views;
  llvm::ArrayRef<llvm::StringLiteral> colourNames; ///< of `TextColour::name`
};

/// Brings everything into the order of output: findings by path, line, column and rule.
void sortReport(Report &report);
/// What orders the findings of a report, see `placeInOrder`: names of the file and of the rule.
std::tuple<llvm::StringRef, uint32_t, llvm::StringRef, uint32_t>
placeInReport(const Report &report, const Finding &finding);

/// Writes a report, sorted before, in one format. Suppressed findings and those of the baseline
/// appear in SARIF only, marked as what they are; the other formats leave them out.
class ReportWriter {
public:
  virtual ~ReportWriter() = default;
  virtual void write(const Report &report, llvm::raw_ostream &out) = 0;
};

struct ReportOptions {
  bool color = false; ///< of the formats only `text` has colours
  bool source = true; ///< `text` shows the program's line
};

} // namespace ncvet
