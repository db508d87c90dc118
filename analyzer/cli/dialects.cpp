// `ncvet dialects`: the controls that are known, and the check of a table of one's own.
#include "analyzer/cli/explain.h"
#include "analyzer/setup/session.h"
#include "formats/packed/shipped.h"
#include "formats/text/failure.h"

#include "llvm/Support/Format.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet::cli {

namespace {

/// Loads the table with all that it extends, and compiles its marks.
llvm::Error checkTable(llvm::StringRef file) {
  OwnDialects own;
  auto id = own.add(file);
  if (!id)
    return id.takeError();
  auto dialect = loadDialect(*id, own.source());
  if (!dialect)
    return dialect.takeError();
  if (llvm::Error wrong = own.checkRules())
    return wrong;
  auto detector = Detector::create(own.summaries());
  if (!detector)
    return failure(file + ": " + llvm::toString(detector.takeError()));
  llvm::outs() << file << ": " << *id << " is well formed: " << (*dialect)->codes.size()
               << " codes, " << (*dialect)->groups.size() << " groups\n";
  return llvm::Error::success();
}

} // namespace

DialectsCommand::DialectsCommand()
    : Command("dialects", "list the controls, or check a table of your own") {
  options.section("Options");
  options.add("--check", &check_, "say whether a table is well formed").valued("FILE");
}

int DialectsCommand::run() {
  if (!check_.empty()) {
    if (llvm::Error wrong = checkTable(check_))
      return fail(std::move(wrong));
    return exitClean;
  }
  for (const DialectSummary &dialect : shippedDialects()) {
    if (dialect.abstract)
      continue;
    llvm::outs() << llvm::left_justify(dialect.id, 12) << "  " << dialect.title;
    if (!dialect.extends.empty())
      llvm::outs() << " (extends " << dialect.extends << ')';
    llvm::outs() << '\n';
  }
  return exitClean;
}

} // namespace ncvet::cli
