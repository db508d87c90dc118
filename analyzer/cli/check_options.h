// Options of `ncvet check`, as the user gave them.
#pragma once

#include "analyzer/cli/setup_options.h"
#include "analyzer/setup/input_files.h"

namespace ncvet::cli {

/// A report and where it goes; `-` is standard output.
struct ReportTarget {
  std::string format, file;
};

/// The options, checked.
struct CheckRequest {
  SessionOptions session;
  std::vector<std::string> paths;
  std::vector<ReportTarget> reports; ///< at most one of them to standard output
  std::optional<FailOn> failOn;      ///< none: as configured
  std::string baseline, writeBaseline;
  std::string stdinFilename;
  std::string timeTrace;
  std::string changedSince, changedLines; ///< commit; file of a patch
  std::string relativeTo;       ///< folder that paths are shown from; empty: the current one
  size_t shard = 0, shards = 1; ///< this one, from 0, of so many
  unsigned jobs = 0;            ///< 0: as many as the machine has processors
  bool stats = false, color = false, quiet = false, exitZero = false;
  bool statistics = false, showSource = true;
  InputChoice inputs;
  bool fix = false, diff = false, unsafeFixes = false;
  bool cache = false;               ///< outcomes are kept for later runs
  std::string cacheDir;             ///< where; empty: where the user's are
  std::vector<std::string> watched; ///< further files whose text counts, from the root

  /// The report on standard output; null when there is none.
  const ReportTarget *shown() const;
  /// Whether people read what is shown: they are told more than the findings, on standard error.
  bool forPeople() const;
};

class CheckOptions {
public:
  void declare(OptionSet &options);
  /// The request; an error says in one line what is wrong with the options.
  llvm::Expected<CheckRequest> request(const OptionSet &options) const;
  /// Whether it is checked again after each change.
  bool watches() const { return watch_; }

private:
  void declareReports(OptionSet &options);
  void declareRun(OptionSet &options);
  llvm::Error checkWatch(bool writes) const;
  llvm::Error checkTogether(const OptionSet &options) const;
  llvm::Error readRules(RuleSettings &rules) const;
  llvm::Error readReports(const OptionSet &options, CheckRequest &request) const;
  llvm::Error readShard(CheckRequest &request) const;
  void readFixes(const OptionSet &options, CheckRequest &request) const;

  SetupOptions setup_;
  std::vector<std::string> paths_;
  std::string profile_;
  std::vector<std::string> select_, ignore_, severity_;
  std::string format_ = "text", output_;
  std::vector<std::string> reports_;
  std::string failOn_, baseline_, writeBaseline_;
  unsigned jobs_ = 0;
  unsigned memory_ = 0; ///< MiB; 0: as much as it takes
  bool stats_ = false, quiet_ = false, exitZero_ = false;
  bool statistics_ = false, showSource_ = false, hideSource_ = false;
  InputChoice inputs_;
  std::string fix_;
  bool diff_ = false, unsafeFixes_ = false, watch_ = false, noCache_ = false;
  std::string cacheDir_;
  std::string changedSince_, changedLines_, shard_, relativeTo_;
  std::string stdinFilename_, color_ = "auto", timeTrace_;
};

} // namespace ncvet::cli
