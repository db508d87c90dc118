// `ncvet view`: programs as a page with findings and tool paths, in the browser.
#include "analyzer/cli/view.h"

#include "analyzer/cli/check.h"
#include "formats/text/failure.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"
#include "llvm/Support/Program.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet::cli {

namespace {

/// A new file that no other user can have prepared, named after the first program.
llvm::Expected<std::string> temporaryPage(llvm::StringRef program) {
  llvm::SmallString<128> file;
  const std::string name = ("ncvet-" + llvm::sys::path::stem(program)).str();
  if (const std::error_code error = llvm::sys::fs::createTemporaryFile(name, "html", file))
    return failure("cannot write a page into the folder for temporary files: " + error.message());
  return file.str().str();
}

/// Shows a page by the program that the system has for that; false: there is none.
bool openPage(const std::string &page) {
  static constexpr llvm::StringLiteral openers[][2] = {
      {"xdg-open", ""}, {"open", ""}, {"rundll32", "url.dll,FileProtocolHandler"}};
  for (const auto &[program, argument] : openers) {
    const auto path = llvm::sys::findProgramByName(program);
    if (!path)
      continue;
    llvm::SmallVector<llvm::StringRef, 3> arguments = {program};
    if (!argument.empty())
      arguments.push_back(argument);
    arguments.push_back(page);
    // What a browser says of itself is nothing for the terminal.
    const llvm::Optional<llvm::StringRef> streams[] = {llvm::None, llvm::StringRef(),
                                                       llvm::StringRef()};
    bool failed = false;
    llvm::sys::ExecuteNoWait(*path, arguments, llvm::None, streams, 0, nullptr, &failed);
    return !failed;
  }
  return false;
}

} // namespace

ViewCommand::ViewCommand() : Command("view", "show programs, findings and tool paths as a page") {
  setup_.declare(options);
  options.section("Output");
  options.add("--output", &output_, "write the page to this file").valued("FILE").shortly('o');
  options.add("--no-open", &noOpen_, "write it, and do not open it in the browser");
  options.operands("PATH", paths_, 1, size_t(-1));
}

int ViewCommand::run() {
  CheckRequest request;
  if (llvm::Error wrong = setup_.apply(request.session))
    return fail(std::move(wrong));
  request.paths = paths_;
  request.quiet = request.exitZero = true;
  std::string page = output_;
  if (page.empty()) {
    auto made = temporaryPage(paths_.front());
    if (!made)
      return fail(made.takeError());
    page = std::move(*made);
  }
  request.reports.push_back({"html", page});
  if (const int status = runCheck(std::move(request)); status != exitClean)
    return status;
  llvm::outs() << page << '\n';
  if (!noOpen_ && !openPage(page))
    return fail("no program is found that opens " + page + "; open it in a browser");
  return exitClean;
}

} // namespace ncvet::cli
