// The programs that calls name.
#pragma once

#include "analyzer/flow/flow_run.h"

namespace ncvet {

/// What a call runs.
struct Callee {
  FileUnit *unit;
  const ProgramInfo *program;
  uint32_t start;
  RegionKind kind = RegionKind::Subprogram;
  int64_t number = notSet;                    ///< for the path; `notSet`: none
  std::optional<Value> repeat = std::nullopt; ///< how often, where the number itself says it
};

/// Finds the programs that calls name, and notes that they are in use.
class Callees {
public:
  explicit Callees(FlowRun &run) : run_(run) {}

  /// The program or block that the block calls; none, with an issue, when there is none.
  std::optional<Callee> find(const Step &step);
  /// The program of a modal call that the block `made` has made, and the call's item where it has
  /// one.
  std::optional<Callee> findModal(FileUnit &unit, const ModalCall &call, const Block &made,
                                  const Item *&item);
  /// The subprogram `name` between brackets, in the callee's file or in one of its own; false:
  /// there is none.
  bool findBracketed(Callee &callee, llvm::StringRef name);

private:
  std::optional<Callee> named(const Step &step, const Item &item, Callee callee);
  std::optional<Callee> external(const Step &step, const Item &item, llvm::StringRef name,
                                 SourceRange range, Callee callee);
  std::optional<Callee> headed(const Step &step, Callee callee);
  std::optional<Callee> local(const Step &step, Callee callee);
  std::optional<Callee> numbered(const Step &step, Callee callee);
  std::nullopt_t missing(FlowIssue kind, const Step &step, SourceRange range) {
    run_.issue(kind, step, range);
    return std::nullopt;
  }

  FlowRun &run_;
  /// By file and place of the name: subprograms between brackets that were found.
  llvm::DenseMap<uint64_t, Callee> bracketed_;
};

} // namespace ncvet
