// A rule's page taken apart: its metadata and the text that people read.
#pragma once

#include "formats/finding/finding.h"

#include <optional>
#include <string>
#include <vector>

namespace ncvet {

/// What changes how a rule works, as its page describes it.
struct RuleOption {
  enum class Type : uint8_t { Flag, Number, Choice };

  std::string name;
  Type type = Type::Number;
  std::string help;
  double fallback = 0; ///< used when nobody sets it: a number, 0 or 1, the index of a name
  std::optional<double> min, max; ///< of a number
  std::vector<std::string> names; ///< of a choice
};

/// How findings of a rule that say the same thing of one file are told.
enum class RepeatedFindings : uint8_t { Each, Same, Alike };

struct RulePage {
  std::vector<std::string> dialects; ///< ids that the page claims to work for
  std::vector<RuleOption> options;
  RepeatedFindings repeated = RepeatedFindings::Each;
  llvm::StringRef body; ///< Markdown without the metadata
};

/// The page of a rule. A page's form is checked when ncvet is built; on bad metadata the lists are
/// empty.
RulePage readRulePage(const RuleInfo &info);

/// The page's text with the programs of one control only, without the paragraphs that introduce
/// others alone; unchanged when it has none of them.
std::string withProgramsOf(llvm::StringRef dialect, llvm::StringRef body);

} // namespace ncvet
