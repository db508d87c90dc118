// Options of `ncvet check`, as the user gave them.
#pragma once

#include "analyzer/cli/command.h"
#include "analyzer/setup/session.h"

namespace ncvet::cli {

/// A further report: `--report FMT:FILE`.
struct ReportTarget {
  std::string format, file;
};

/// The options, checked.
struct CheckRequest {
  SessionOptions session;
  std::vector<std::string> paths;
  std::string format;
  std::vector<ReportTarget> reports;
  std::optional<FailOn> failOn; ///< none: as configured
  std::string baseline, writeBaseline;
  std::string stdinFilename;
  std::string timeTrace;
  unsigned jobs = 0; ///< 0: as many as the machine has processors
  bool stats = false, color = false;
  bool fix = false, diff = false, unsafeFixes = false;
};

class CheckOptions {
public:
  CheckOptions();
  llvm::cl::SubCommand command;
  /// The request; an error says in one line what is wrong with the options.
  llvm::Expected<CheckRequest> request() const;

private:
  llvm::Error readRules(RuleSettings &rules) const;
  llvm::Error readReports(CheckRequest &request) const;

  template <typename T>
  using Option = llvm::cl::opt<T>;
  llvm::cl::OptionCategory category_;
  llvm::cl::list<std::string> paths_;
  Option<std::string> dialect_, machine_, config_, profile_;
  llvm::cl::list<std::string> select_, ignore_, severity_;
  Option<std::string> format_;
  llvm::cl::list<std::string> report_;
  Option<std::string> failOn_, baseline_, writeBaseline_;
  Option<unsigned> jobs_;
  Option<bool> stats_;
  Option<std::string> fix_;
  Option<bool> diff_, unsafeFixes_;
  Option<std::string> stdinFilename_, color_, timeTrace_;

  friend class CommandLine;
};

} // namespace ncvet::cli
