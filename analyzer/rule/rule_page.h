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

/// How findings of a rule that say the same thing of one file are told. `Many`: alike ones, once
/// there are so many that the text is made so.
enum class RepeatedFindings : uint8_t { Each, Same, Alike, Many };

/// What a text must program for findings of a rule to be due in it, as bits.
enum TextTrait : uint8_t {
  programsSpindle = 1,   ///< a speed, a code of the spindle, a tool change
  programsThreeAxes = 2, ///< X, Y and Z
};

struct RulePage {
  std::vector<std::string> dialects; ///< ids that the page claims to work for
  std::vector<RuleOption> options;
  RepeatedFindings repeated = RepeatedFindings::Each;
  uint8_t dueWhere = 0; ///< TextTrait bits, all of which a text must have
  llvm::StringRef body; ///< Markdown without the metadata
};

/// The page of a rule. A page's form is checked when ncvet is built; on bad metadata the lists are
/// empty.
RulePage readRulePage(const RuleInfo &info);
/// The same, read once for the whole run. For several threads.
const RulePage &rulePage(RuleId rule);

} // namespace ncvet
