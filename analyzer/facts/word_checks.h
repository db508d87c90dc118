// Reads the word formats of the tables for rules: which required words a block lacks, and which
// words have a value that their code does not take.
#pragma once

#include "analyzer/rule/rule.h"

#include <map>

namespace ncvet {

/// Which family of rules speaks for a word of a code's format. Each word belongs to exactly one.
enum class WordTopic : uint8_t {
  Block,  ///< everything else: block-missing-word, block-value-out-of-range
  Cycle,  ///< words of canned and turning cycles
  Peck,   ///< peck depths of cycles
  Lead,   ///< thread leads
  Target, ///< programs and blocks that are called or jumped to
  Feed,   ///< F of cycles and moves
  Speed   ///< S of the spindle modes
};

WordTopic topicOf(const CodeInfo &code, const WordSpec &spec);

/// A required word that the block lacks.
struct MissingWord {
  const WordSpec *spec = nullptr;
  bool certain = true; ///< false: a cycle that may be active already keeps its value on some path
};

/// The required words of the code of a `Code` event that its block lacks, in the table's order.
llvm::SmallVector<MissingWord, 2> missingWords(const RuleContext &ctx, const Event &event);

/// Reports those missing words for which `mine` is true, each with the table's severity.
void reportMissingWords(RuleContext &ctx, const Event &event,
                        llvm::function_ref<bool(const CodeInfo &, const WordSpec &)> mine);

/// Which rule speaks for a required word that is missing. A peck that a variable keeps from block
/// to block is missing like any other value of its cycle.
WordTopic topicOfMissing(const CodeInfo &code, const WordSpec &spec);

/// How a value breaks the bounds of its word.
enum class Breach : uint8_t {
  PointMissing, ///< written without the decimal point that it needs
  PointWritten, ///< written with a decimal point where none may be
  TooSmall,
  TooLarge,
  NotWhole,
  NotListed ///< none of the values that the code knows
};

/// The bound that a word certainly breaks; none when it keeps them or its value is not known.
std::optional<Breach> breachOf(const ValueTest &test, const Word &word,
                               const ConditionContext &context);

/// Whether the block has a word for which the code has bounds, or gives a variable of it.
bool namesRange(const Block &block, const CodeInfo &code);

/// Reports the words of the block that certainly break the bounds of the event's code and for which
/// `mine` is true.
void reportWordRanges(RuleContext &ctx, const Event &event,
                      llvm::function_ref<bool(const CodeInfo &, const WordSpec &, Breach)> mine);

/// Values of variables that a rule has found fault with, so that a cycle that is called again with
/// a value that it keeps says nothing new.
class KeptFaults {
public:
  /// The block gives the variable a value of its own, wrong or right.
  void given(uint64_t variable, std::optional<double> wrong, const RuleContext &ctx);
  /// True when `value`, wrong and of a block before, was not spoken of yet. The same block may say
  /// it again, as it does when several states or passes reach it.
  bool speaks(uint64_t variable, double value, const RuleContext &ctx);
  const auto &remembered() const { return faults_; }

private:
  struct Fault {
    double value = 0;
    TextPlace block;
  };
  std::map<uint64_t, Fault> faults_; ///< by variable
};

/// Reports the variables of the format of the event's code that the block gives no value and whose
/// value of a block before certainly breaks the bounds: at the code. Later runs of a cycle only
/// note what their blocks give.
void reportKeptRanges(RuleContext &ctx, const Event &event, KeptFaults &faults,
                      llvm::function_ref<bool(const CodeInfo &, const WordSpec &)> mine);

/// Whether the issue is that of a synchronised action without its DO: the reader gives it the place
/// of the statement.
bool lacksAction(const RuleContext &ctx, const SyntaxIssue &issue);

/// Whether the issue is an expression that begins with a function which the control lacks.
bool namesLackedFunction(const RuleContext &ctx, const SyntaxIssue &issue);

/// Whether the block gives a value anew to a variable at which the code has notices for `rule`.
bool givesNoticedValue(const Block &block, const CodeInfo &code, llvm::StringRef rule);

/// What the bounds ask for: "0 or 1", "greater than 0", "a whole number from 1 to 4".
std::string describe(const ValueTest &test);

/// A word in backticks as its block writes it, with its value where that is computed and known:
/// "`P#101` = 100".
std::string withValue(const RuleContext &ctx, const Word &word, const Interval &value);

/// Reports the words of the block of which the event's code takes only one of two sets.
void reportExcludedWords(RuleContext &ctx, const Event &event);

} // namespace ncvet
