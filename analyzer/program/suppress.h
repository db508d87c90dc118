// Suppression: comments in a program that say which findings are not wanted there.
//
//     (ncvet: allow rule, rule)      on the block, or alone on the line above it
//     (ncvet: off rule) … (ncvet: on rule)
//     (ncvet: allow-file rule)       in the whole file
//
// A rule is named by its id, its category or `all`; `off` and `on` without a name mean all. After
// ` -- ` there is room for a reason. Upper case is read as well: many controls know no other.
#pragma once

#include "formats/finding/finding.h"
#include "formats/readers/reader.h"

#include <vector>

namespace ncvet {

/// One name in a suppression comment.
struct SuppressedName {
  SourceRange range;          ///< of the name; of the word `off` or `on` where none is given
  std::vector<RuleId> rules;  ///< empty: no rule has this name
  uint32_t begin = 0;         ///< first byte that it covers
  std::vector<uint32_t> ends; ///< per rule: after the last byte
  bool dead = false; ///< covers nothing, whatever is found: an `on` without `off`, no block below
  bool used = false; ///< has suppressed a finding
};

enum class SuppressionVerb : uint8_t { Allow, AllowFile, Off, On, Unknown };

struct Suppression {
  SuppressionVerb verb = SuppressionVerb::Unknown;
  SourceRange verbRange; ///< of `allow`, `off`, …; of `ncvet:` when nothing follows
  std::vector<SuppressedName> names;
};

/// Calls its argument with the place of each colon of a text, ascending.
using EachColon = llvm::function_ref<void(llvm::function_ref<void(uint32_t)>)>;

/// The rules that a name in small letters means; none: no rule has it.
using RulesOfName = std::vector<RuleId> (*)(llvm::StringRef name);

/// All suppression comments of a file, in their order. Reads only the blocks around the comments.
std::vector<Suppression> findSuppressions(const SourceFile &source, const Reader &reader,
                                          EachColon eachColon, RulesOfName rulesOf);

/// Marks the findings that lie in `source` and are covered, and the names that cover them.
void applySuppressions(std::vector<Suppression> &suppressions, const SourceFile &source,
                       llvm::MutableArrayRef<Finding> findings);

} // namespace ncvet
