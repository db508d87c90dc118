// The clauses of the controls' rules: `rules/CATEGORY/clauses/REFERENCE.json`. A rule of a
// control's manual says more than one thing ("or while ...", "also ..."); each is a clause with a
// test.
#pragma once

#include "llvm/ADT/StringRef.h"
#include "llvm/Support/Error.h"

#include <string>
#include <vector>

namespace ncvet::test {

/// One thing that a rule of a manual says.
struct Clause {
  std::string reference; ///< of which manual: `ecs`, `haas-lathe`, the name of the file
  std::string category;  ///< folder of rules
  std::string local;     ///< the rule's name in that reference
  std::string rule;      ///< that ncvet reports it with
  std::string says;
  std::string dialect;            ///< table that the programs are checked with
  std::string machine;            ///< text of a machine profile, or empty
  std::vector<std::string> wrong; ///< lines; those that are reported begin with "> "
  std::vector<std::string> right; ///< nothing is reported; may be empty
  std::vector<std::string> also;  ///< rules that may report in `right`
  bool whole = false;             ///< the programs are whole, not put into a frame
  std::string missing;            ///< why `wrong` is not reported yet; empty: it is
  std::string falseAlarm;         ///< why `right` is reported yet; empty: it is not

  std::string name() const { return reference + "/" + category + ": " + local + ": " + says; }
};

/// The blocks before and after a clause's lines, which make them a program of their control.
struct Frame {
  std::string file = "PROGRAM.nc"; ///< name of the program
  std::vector<std::string> before, after;
};

/// The clauses of one file; fails with what is wrong in it.
llvm::Expected<std::vector<Clause>> readClauses(const std::string &path);

/// The paths of all such files, in order.
std::vector<std::string> clauseFiles();

/// The frame of a dialect's programs, without blocks where `frames.json` has none.
Frame frameOf(llvm::StringRef dialect);

} // namespace ncvet::test
