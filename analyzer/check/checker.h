// Checker: one file from its setup to its findings, with suppressions and what names a finding.
#pragma once

#include "analyzer/check/check_memory.h"
#include "analyzer/check/check_store.h"
#include "analyzer/flow/outer_calls.h"
#include "analyzer/setup/session.h"

#include <atomic>

namespace ncvet {

struct StatesAt; // analyzer/flow/observed_block.h

/// A finding with what its fingerprint is made of.
struct CheckedFinding {
  Finding finding;
  std::string program;             ///< name of the enclosing program
  std::string blockText;           ///< see `fingerprintText`
  FailOn failOn = Severity::Error; ///< as configured where it was found
};

struct FileOutcome {
  std::string error;        ///< not empty: the file was not checked
  std::string dialect;      ///< id of the control
  std::string dialectTitle; ///< its name
  std::string reason;       ///< why this dialect
  bool guessed = false;     ///< … nobody named it
  bool sure = false;        ///< of the guess
  uint64_t blocks = 0;
  bool complete = true;
  std::vector<std::string> cuts; ///< why not complete
  /// The compensated contours, one line each: "12: on the left, 8 elements, safe up to R6.00".
  std::vector<std::string> contours;
  FailOn failOn = Severity::Error;
  /// Those that are suppressed among them, and those about unused suppressions.
  std::vector<CheckedFinding> findings;
  /// (name of the file, offset) of suppressions in called files that this file made use of.
  std::vector<std::pair<std::string, uint32_t>> usedSuppressions;
  bool postponed = false;     ///< see `OuterCalls`: the file is checked later
  bool asksOuter = false;     ///< it is one that would be postponed
  bool restsOnOthers = false; ///< see `AnalysisResult`
  uint64_t work = 0;          ///< the same
  /// See `AnalysisResult`.
  FollowedCallsOfFiles followed;
};

/// Checks `file`, a file of `sources`. Findings may lie in other files that it calls; these are
/// added to `sources`. `cancel`, when given, ends the check early, with what was found so far.
/// `again` and `store` change how long the check takes, never what it finds.
FileOutcome checkFile(Session &session, SourceSet &sources, const SourceFile &file,
                      const std::atomic<bool> *cancel = nullptr, Recheck *again = nullptr,
                      CheckStore *store = nullptr);

/// The states before and after the block of `file` that begins at `offset`, as its check follows
/// the file: with what checks have left in `again`, and leaving there what the next check needs. No
/// states when the file has no setup.
StatesAt statesInCheck(Session &session, SourceSet &sources, const SourceFile &file,
                       uint32_t offset, const std::atomic<bool> *cancel, Recheck &again);

/// After the first check of `file`: finds out what else checks of later versions may ask for, so
/// that the first of these that does need not look through the whole text.
void prepareChecks(Session &session, SourceSet &sources, const SourceFile &file, Recheck &first);

} // namespace ncvet
