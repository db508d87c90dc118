// The command line: which subcommand, and what is wrong with it in one line.
#include "analyzer/cli/command_line.h"

#include "analyzer/cli/check.h"
#include "analyzer/cli/explain.h"
#include "analyzer/cli/lsp.h"
#include "analyzer/cli/trace.h"
#include "formats/dialect/json_reader.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet::cli {

namespace cl = llvm::cl;

namespace {

constexpr llvm::StringLiteral usage =
    R"(ncvet checks NC part programs before they run.

    ncvet check [PATH...]     find what is wrong in files and folders
    ncvet trace FILE          the motions that the control would make
    ncvet explain RULE        the page of a rule
    ncvet rules               all rules
    ncvet dialects            all controls
    ncvet lsp                 serve an editor on standard input and output

`ncvet COMMAND --help` shows a command's options. Exit code: 0 nothing found, 1 findings,
2 wrong usage or something that cannot be read.
)";

constexpr llvm::StringLiteral programName = "ncvet";

/// cl's errors name the program and spread over lines: `ncvet: WHAT  Try: '…'`, `ncvet: Did you …`.
std::string inOneLine(llvm::StringRef text) {
  std::string message;
  llvm::SmallVector<llvm::StringRef, 4> lines;
  text.split(lines, '\n', -1, /*KeepEmpty=*/false);
  for (llvm::StringRef line : lines) {
    line.consume_front(programName);
    line.consume_front(": ");
    message += message.empty() ? "" : " ";
    message += line.trim();
  }
  const size_t blank = message.find("  Try:");
  if (blank != std::string::npos)
    message.erase(blank, 1);
  return message;
}

int unknownCommand(llvm::StringRef given) {
  return fail("unknown command \"" + given + "\"" +
              suggest(given, {"check", "explain", "rules", "dialects", "trace", "lsp"}));
}

} // namespace

int fail(const llvm::Twine &message) {
  llvm::outs().flush();
  llvm::errs() << "ncvet: error: " << message << '\n';
  return exitFailure;
}

int runCommandLine(int argc, const char *const *argv) {
  const llvm::StringRef first = argc > 1 ? argv[1] : "";
  if (first.empty()) {
    llvm::errs() << usage;
    return exitFailure;
  }
  if (first == "--help" || first == "-h" || first == "-help" || first == "help") {
    llvm::outs() << usage;
    llvm::outs().flush();
    return exitClean;
  }
  if (first == "--version" || first == "-version" || first == "-V") {
    llvm::outs() << "ncvet " << NCVET_VERSION << '\n';
    llvm::outs().flush();
    return exitClean;
  }

  CheckCommand check;
  TraceCommand trace;
  ExplainCommand explain;
  RulesCommand rules;
  DialectsCommand dialects;
  LspCommand lsp;
  Command *const commands[] = {&check, &trace, &explain, &rules, &dialects, &lsp};
  Command *const *const wanted = llvm::find_if(
      commands, [&](Command *command) { return command->subcommand().getName() == first; });
  if (wanted == std::end(commands))
    return unknownCommand(first);

  std::vector<const char *> arguments(argv, argv + argc);
  arguments[0] = programName.data(); // as help and errors name it, wherever it was started from
  std::string errors;
  llvm::raw_string_ostream stream(errors);
  if (!cl::ParseCommandLineOptions(argc, arguments.data(), "", &stream))
    return fail(inOneLine(stream.str()));
  return (*wanted)->run();
}

} // namespace ncvet::cli
