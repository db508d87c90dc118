// Options of a subcommand as data: one declaration gives parsing, messages and help.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/SmallVector.h"
#include "llvm/ADT/StringRef.h"
#include "llvm/Support/Error.h"
#include "llvm/Support/raw_ostream.h"

#include <deque>
#include <string>
#include <variant>
#include <vector>

namespace ncvet::cli {

/// One option. Names and texts are literals.
struct Option {
  /// What the option sets. A list may be repeated, and its values are separated by commas.
  using Target = std::variant<bool *, unsigned *, std::string *, std::vector<std::string> *>;

  llvm::StringRef name; ///< with its dashes: `--format`
  Target target;
  llvm::StringRef help;
  llvm::StringRef section;
  llvm::StringRef value = {};   ///< what help calls the value
  llvm::StringRef expects = {}; ///< what a value must be: "a number from 1"
  llvm::StringRef implied = {}; ///< the value may be left out, and is this one then
  char letter = 0;              ///< the short form, `-o`
  bool whole = false;           ///< values of a list are not separated by commas
  bool hidden = false;          ///< not in help
  bool fromEnvironment = false; ///< `NCVET_FORMAT` counts where the option is not given
  llvm::SmallVector<llvm::StringRef, 4> choices = {}; ///< the only values
  std::string given = {}; ///< after parsing: how it was given, `--format` or `NCVET_FORMAT`

  Option &valued(llvm::StringRef called, llvm::StringRef wanted = {}) {
    value = called;
    expects = wanted;
    return *this;
  }
  Option &among(llvm::ArrayRef<llvm::StringRef> values) {
    choices.assign(values.begin(), values.end());
    return *this;
  }
  Option &shortly(char one) {
    letter = one;
    return *this;
  }
  Option &implies(llvm::StringRef one) {
    implied = one;
    return *this;
  }
  Option &wholeValues() {
    whole = true;
    return *this;
  }
  Option &hide() {
    hidden = true;
    return *this;
  }
  Option &environment() {
    fromEnvironment = true;
    return *this;
  }
};

/// What follows the options.
struct Operands {
  llvm::StringRef name; ///< as help shows them, `PATH`; empty: the command takes none
  std::vector<std::string> *list = nullptr;
  size_t least = 0, most = 0;
};

enum class Parsed : uint8_t { Run, HelpWasWanted };

/// The options of one subcommand.
class OptionSet {
public:
  OptionSet(llvm::StringRef command, llvm::StringRef summary)
      : command_(command), summary_(summary) {}

  llvm::StringRef command() const { return command_; }
  llvm::StringRef summary() const { return summary_; }
  /// Options that are added from now on are in this section of the help.
  void section(llvm::StringRef title) { section_ = title; }
  Option &add(llvm::StringRef name, Option::Target target, llvm::StringRef help);
  void operands(llvm::StringRef name, std::vector<std::string> &list, size_t least, size_t most);

  /// Reads the arguments after the subcommand's name. No argument is anything else than it looks
  /// like: a file whose name begins with `@` is a file. An error says in one line what is expected.
  llvm::Expected<Parsed> parse(llvm::ArrayRef<const char *> arguments);
  /// Whether the option was given, on the command line or by the environment.
  bool isGiven(llvm::StringRef name) const { return !find(name).given.empty(); }
  std::string help() const;

private:
  const Option &find(llvm::StringRef name) const;
  llvm::Error readOperands(const std::vector<std::string> &rest);
  llvm::Error unknown(llvm::StringRef given) const;
  llvm::Error readEnvironment();
  llvm::Error mentionHelp(const llvm::Twine &message) const;
  void writeEnvironment(llvm::raw_ostream &out) const;

  llvm::StringRef command_, summary_, section_;
  std::deque<Option> options_; ///< they stay where they are
  Operands operands_;
};

/// `name` with the nearest of `known`: "; did you mean ...?"; empty when none is near.
std::string nearest(llvm::StringRef given, llvm::ArrayRef<llvm::StringRef> known);

/// The parts of a list that is separated by commas, without blanks round them and without empty
/// ones.
std::vector<std::string> listParts(llvm::StringRef text);

} // namespace ncvet::cli
