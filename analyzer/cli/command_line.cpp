// The command line: which subcommand, and what is wrong with it in one line.
#include "analyzer/cli/command_line.h"

#include "analyzer/cli/check.h"
#include "analyzer/cli/config_command.h"
#include "analyzer/cli/dap.h"
#include "analyzer/cli/explain.h"
#include "analyzer/cli/lsp.h"
#include "analyzer/cli/merge.h"
#include "analyzer/cli/trace.h"
#include "analyzer/cli/view.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet::cli {

namespace {

constexpr llvm::StringLiteral usage =
    R"(ncvet checks NC part programs before they run.

    ncvet check [PATH...]     find what is wrong in files and folders
    ncvet view PATH...        programs, findings and tool paths as a page in the browser
    ncvet trace FILE          the motions that the control would make
    ncvet explain RULE        the page of a rule
    ncvet rules               all rules
    ncvet dialects            all controls
    ncvet config [PATH]       which settings count for it, and who gave them
    ncvet init [FOLDER]       write a .ncvet.json to begin with
    ncvet merge FILE...       one report of those of the parts of a check
    ncvet lsp                 serve an editor on standard input and output
    ncvet dap                 the same for its debugger: a dry run, block by block

`ncvet COMMAND --help` shows a command's options. Exit code: 0 no error found, 1 an error
(`check --fail-on` makes more count), 2 wrong usage or something that cannot be read or written.
)";

/// All subcommands.
struct Commands {
  CheckCommand check;
  ViewCommand view;
  TraceCommand trace;
  ExplainCommand explain;
  RulesCommand rules;
  DialectsCommand dialects;
  LspCommand lsp;
  DapCommand dap;
  MergeCommand merge;
  ConfigCommand config;
  InitCommand init;

  std::vector<Command *> all() {
    return {&check, &view, &trace, &explain, &rules, &dialects, &config, &init, &merge, &lsp, &dap};
  }

  Command *find(llvm::StringRef name) {
    for (Command *command : all())
      if (command->options.command() == name)
        return command;
    return nullptr;
  }
};

int unknownCommand(Commands &commands, llvm::StringRef given) {
  if (given.startswith("-"))
    return fail("unknown option \"" + given + "\": a command comes first; see `ncvet --help`");
  std::vector<llvm::StringRef> names;
  for (const Command *command : commands.all())
    names.push_back(command->options.command());
  const std::string near = nearest(given, names);
  if (near.empty() && llvm::sys::fs::exists(given))
    return fail("unknown command \"" + given + "\"; to check it: ncvet check " + given);
  return fail("unknown command \"" + given + "\"" + (near.empty() ? "; see `ncvet --help`" : near));
}

int runCommand(Command &command, llvm::ArrayRef<const char *> arguments) {
  auto parsed = command.options.parse(arguments);
  if (!parsed)
    return fail(parsed.takeError());
  if (*parsed == Parsed::Run)
    return command.run();
  llvm::outs() << command.options.help();
  return exitClean;
}

int dispatch(llvm::ArrayRef<const char *> arguments) {
  const llvm::StringRef first = arguments.empty() ? "" : arguments[0];
  if (first.empty()) {
    llvm::errs() << usage;
    return exitFailure;
  }
  Commands commands;
  const bool help = first == "--help" || first == "-h" || first == "help";
  if (first == "help" && arguments.size() > 1) {
    if (const Command *command = commands.find(arguments[1])) {
      llvm::outs() << command->options.help();
      return exitClean;
    }
    return unknownCommand(commands, arguments[1]);
  }
  if (help) {
    llvm::outs() << usage;
    return exitClean;
  }
  if (first == "--version" || first == "-V") {
    llvm::outs() << "ncvet " << NCVET_VERSION << '\n';
    return exitClean;
  }
  if (Command *command = commands.find(first))
    return runCommand(*command, arguments.drop_front());
  return unknownCommand(commands, first);
}

} // namespace

int fail(const llvm::Twine &message) {
  llvm::outs().flush();
  llvm::errs() << "ncvet: error: " << message << '\n';
  return exitFailure;
}

int fail(llvm::Error error) { return fail(llvm::toString(std::move(error))); }

int runCommandLine(int argc, const char *const *argv) {
  // A program may be started without even its own name.
  const int code = dispatch(llvm::makeArrayRef(argv, size_t(argc)).drop_front(argc > 0 ? 1 : 0));
  llvm::outs().flush();
  if (!llvm::outs().has_error())
    return code;
  const std::error_code error = llvm::outs().error();
  llvm::outs().clear_error(); // else LLVM ends the process by itself
  return fail("cannot write to standard output: " + error.message());
}

} // namespace ncvet::cli
