// Options of a subcommand: read by CLI11, which knows no response files and no other tricks; told
// in our own words.
#include "analyzer/cli/options.h"

#include "formats/dialect/json_reader.h"
#include "formats/text/failure.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/Process.h"
#include "llvm/Support/raw_ostream.h"
#include <CLI/CLI.hpp>

#include <deque>

namespace ncvet::cli {

namespace {

/// `--format` as the environment has it: NCVET_FORMAT.
std::string environmentName(const Option &option) {
  std::string name = "NCVET_" + option.name.drop_front(2).upper();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string wanted(const Option &option) {
  if (option.choices.empty())
    return (option.expects.empty() ? option.value : option.expects).str();
  std::string text = "one of ";
  llvm::StringRef separator;
  for (const llvm::StringRef choice : option.choices) {
    text += (separator + choice).str();
    separator = ", ";
  }
  return text;
}

llvm::Error wrongValue(const Option &option, llvm::StringRef given) {
  return failure(llvm::Twine(option.given) + " wants " + wanted(option) + ", not \"" + given +
                 "\"" + nearest(given, option.choices));
}

/// Gives the option the value that it was given as `option.given`.
llvm::Error take(Option &option, llvm::StringRef value) {
  if (!option.choices.empty() && !llvm::is_contained(option.choices, value))
    return wrongValue(option, value);
  if (auto *const *text = std::get_if<std::string *>(&option.target)) {
    if (value.empty())
      return failure(llvm::Twine(option.given) + " wants " + wanted(option));
    **text = value.str();
  } else if (auto *const *number = std::get_if<unsigned *>(&option.target)) {
    if (value.getAsInteger(10, **number) || **number == 0)
      return wrongValue(option, value);
  } else if (auto *const *list = std::get_if<std::vector<std::string> *>(&option.target)) {
    const std::vector<std::string> parts =
        option.whole ? std::vector<std::string>{value.str()} : listParts(value);
    (*list)->insert((*list)->end(), parts.begin(), parts.end());
  }
  return llvm::Error::success();
}

constexpr size_t helpWidth = 100; ///< columns of the help
constexpr size_t helpColumn = 26; ///< where what an option does is told

/// `text` from the column on, in lines that fit.
void writeWrapped(llvm::raw_ostream &out, size_t column, llvm::StringRef text) {
  if (column + 2 > helpColumn) {
    out << '\n';
    column = 0;
  }
  out.indent(unsigned(helpColumn - column));
  column = helpColumn;
  llvm::StringRef separator;
  while (!text.empty()) {
    const auto [word, rest] = text.split(' ');
    if (column + separator.size() + word.size() > helpWidth) {
      out << '\n';
      out.indent(helpColumn);
      column = helpColumn;
      separator = "";
    }
    out << separator << word;
    column += separator.size() + word.size();
    separator = " ";
    text = rest;
  }
  out << '\n';
}

} // namespace

std::string nearest(llvm::StringRef given, llvm::ArrayRef<llvm::StringRef> known) {
  const std::string text = suggest(given, known);
  return llvm::StringRef(text).startswith("; did") ? text : "";
}

std::vector<std::string> listParts(llvm::StringRef text) {
  std::vector<std::string> parts;
  llvm::SmallVector<llvm::StringRef, 8> split;
  text.split(split, ',');
  for (const llvm::StringRef part : split)
    if (!part.trim().empty())
      parts.push_back(part.trim().str());
  return parts;
}

Option &OptionSet::add(llvm::StringRef name, Option::Target target, llvm::StringRef help) {
  Option &option = options_.emplace_back();
  option.name = name;
  option.target = target;
  option.help = help;
  option.section = section_;
  return option;
}

void OptionSet::operands(llvm::StringRef name, std::vector<std::string> &list, size_t least,
                         size_t most) {
  operands_ = {name, &list, least, most};
}

const Option &OptionSet::find(llvm::StringRef name) const {
  const auto option =
      llvm::find_if(options_, [&](const Option &known) { return known.name == name; });
  assert(option != options_.end() && "no such option is declared");
  return *option;
}

llvm::Error OptionSet::mentionHelp(const llvm::Twine &message) const {
  return failure(message + "; see `ncvet " + command_ + " --help`");
}

llvm::Error OptionSet::unknown(llvm::StringRef given) const {
  given = given.split('=').first;
  std::vector<llvm::StringRef> known = {"--help"};
  for (const Option &option : options_)
    if (!option.hidden)
      known.push_back(option.name);
  return mentionHelp("unknown option \"" + given + "\"" + nearest(given, known));
}

llvm::Error OptionSet::readOperands(const std::vector<std::string> &rest) {
  bool onlyOperands = false; // after `--`
  std::vector<std::string> found;
  for (const std::string &text : rest) {
    if (!onlyOperands && text == "--")
      onlyOperands = true;
    else if (!onlyOperands && text.size() > 1 && text[0] == '-')
      return unknown(text);
    else
      found.push_back(text);
  }
  if (found.size() > operands_.most)
    return mentionHelp("\"" + llvm::Twine(found[operands_.most]) + "\" is too much: ncvet " +
                       command_ + " takes " +
                       (operands_.most ? "one " + operands_.name : llvm::Twine("options only")));
  if (found.size() < operands_.least)
    return mentionHelp("ncvet " + command_ + " wants " +
                       (operands_.least == 1 ? "a " : "at least two of ") + operands_.name);
  if (operands_.list)
    *operands_.list = std::move(found);
  return llvm::Error::success();
}

llvm::Error OptionSet::readEnvironment() {
  for (Option &option : options_) {
    if (!option.fromEnvironment || !option.given.empty())
      continue;
    const std::string name = environmentName(option);
    const auto value = llvm::sys::Process::GetEnv(name);
    if (!value || value->empty())
      continue;
    option.given = name;
    if (bool *const *flag = std::get_if<bool *>(&option.target)) {
      if (*value != "0" && *value != "1")
        return failure(name + " wants 0 or 1, not \"" + *value + "\"");
      **flag = *value == "1";
    } else if (llvm::Error wrong = take(option, *value)) {
      return wrong;
    }
  }
  return llvm::Error::success();
}

namespace {

/// Options as CLI11 knows them, each with ours.
class ArgumentReader {
public:
  explicit ArgumentReader(std::deque<Option> &options) {
    app_.set_help_flag();
    app_.allow_extras();
    app_.add_flag("-h,--help", helpWanted_);
    for (Option &option : options)
      read_.emplace_back(&option, declare(option));
  }

  llvm::Error parse(llvm::ArrayRef<const char *> arguments) {
    // As CLI11 takes them: the last one first.
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    if (llvm::Error wrong = refuseEmpty(reversed))
      return wrong;
    try {
      app_.parse(reversed);
    } catch (const CLI::Error &error) {
      return translated(error.what());
    }
    return llvm::Error::success();
  }

  bool helpWanted() const { return helpWanted_; }
  /// What is no option that is known, and `--`.
  std::vector<std::string> rest() const { return app_.remaining(); }

  llvm::Error takeValues() const {
    for (const auto &[option, reader] : read_) {
      if (reader->count() == 0)
        continue;
      option->given = option->name.str();
      if (std::holds_alternative<bool *>(option->target))
        continue;
      for (const std::string &value : reader->results())
        if (llvm::Error wrong = take(*option, value))
          return wrong;
    }
    return llvm::Error::success();
  }

private:
  CLI::Option *declare(Option &option) {
    std::string names = option.letter ? std::string("-") + option.letter + "," : "";
    names += option.name;
    if (bool *const *flag = std::get_if<bool *>(&option.target))
      return app_.add_flag(names, **flag)->disable_flag_override();
    values_.emplace_back();
    if (!option.implied.empty())
      return app_.add_flag(names + "{" + option.implied.str() + "}", values_.back());
    return app_.add_option(names, values_.back())->type_size(1)->allow_extra_args(false);
  }

  /// CLI11 would take the next argument as the value of `--format=`.
  llvm::Error refuseEmpty(llvm::ArrayRef<std::string> arguments) const {
    for (const std::string &argument : arguments)
      for (const auto &[option, reader] : read_)
        if (argument == (option->name + "=").str())
          return failure(option->name + " wants " + wanted(*option));
    return llvm::Error::success();
  }

  /// The library's messages begin with the name of the option.
  llvm::Error translated(llvm::StringRef message) const {
    const llvm::StringRef name = message.take_until([](char c) { return c == ':' || c == ' '; });
    for (const auto &[option, reader] : read_)
      if (option->name == name || option->name.drop_front(2) == name)
        return option->value.empty() ? failure(option->name + " takes no value")
                                     : failure(option->name + " wants " + wanted(*option));
    return failure(message);
  }

  CLI::App app_;
  bool helpWanted_ = false;
  std::deque<std::vector<std::string>> values_; ///< they stay where they are
  std::vector<std::pair<Option *, CLI::Option *>> read_;
};

} // namespace

llvm::Expected<Parsed> OptionSet::parse(llvm::ArrayRef<const char *> arguments) {
  ArgumentReader reader(options_);
  if (llvm::Error wrong = reader.parse(arguments))
    return wrong;
  if (reader.helpWanted())
    return Parsed::HelpWasWanted;
  if (llvm::Error wrong = reader.takeValues())
    return wrong;
  if (llvm::Error wrong = readOperands(reader.rest()))
    return wrong;
  if (llvm::Error wrong = readEnvironment())
    return wrong;
  return Parsed::Run;
}

void OptionSet::writeEnvironment(llvm::raw_ostream &out) const {
  std::string names;
  for (const Option &option : options_)
    if (option.fromEnvironment)
      names += (names.empty() ? "" : ", ") + environmentName(option);
  if (names.empty())
    return;
  out << "\nEnvironment, where the option is not given:\n  variables";
  writeWrapped(out, 11, names);
}

std::string OptionSet::help() const {
  std::string text;
  llvm::raw_string_ostream out(text);
  out << "ncvet " << command_ << ": " << summary_ << "\n\n    ncvet " << command_ << " [OPTION...]";
  if (!operands_.name.empty())
    out << (operands_.least ? " " : " [") << operands_.name << (operands_.most > 1 ? "..." : "")
        << (operands_.least ? "" : "]");
  out << '\n';
  llvm::StringRef section;
  for (const Option &option : options_) {
    if (option.hidden)
      continue;
    if (option.section != section)
      out << '\n' << option.section << ":\n";
    section = option.section;
    std::string head = option.letter ? std::string("  -") + option.letter + ", " : "  ";
    head += option.name;
    if (!option.implied.empty())
      head += ("[=" + option.value + "]").str();
    else if (!option.value.empty())
      head += (" " + option.value).str();
    out << head;
    writeWrapped(out, head.size(), option.help);
  }
  writeEnvironment(out);
  return out.str();
}

} // namespace ncvet::cli
