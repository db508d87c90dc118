// Options that several subcommands have: the control, the machine, the configuration.
#include "analyzer/cli/setup_options.h"

#include "formats/packed/shipped.h"

namespace ncvet::cli {

void SetupOptions::declare(OptionSet &options) {
  options.section("Control and machine");
  options.add("--dialect", &dialect, "the control, or a table's file; auto (default): found out")
      .valued("ID", "the id of a control (`ncvet dialects` lists them), a table's file, or auto")
      .environment();
  options.add("--machine", &machine, "profile of the machine").valued("FILE").environment();
  options.add("--config", &config, "configuration instead of the nearest .ncvet.json")
      .valued("FILE")
      .environment();
}

llvm::Error SetupOptions::apply(SessionOptions &session) const {
  session.dialect = dialect;
  session.configFile = config;
  if (machine.empty())
    return llvm::Error::success();
  auto profile = readMachine(machine);
  if (!profile)
    return profile.takeError();
  session.machine = std::move(*profile);
  return llvm::Error::success();
}

llvm::Error checkDialect(llvm::StringRef id) {
  const std::vector<DialectSummary> dialects = shippedDialects();
  std::vector<llvm::StringRef> known;
  for (const DialectSummary &dialect : dialects)
    if (!dialect.abstract)
      known.push_back(dialect.id);
  if (llvm::is_contained(known, id))
    return llvm::Error::success();
  const std::string near = nearest(id, known);
  return failure("unknown dialect \"" + id + "\"" +
                 (near.empty() ? "; `ncvet dialects` lists them" : near));
}

llvm::Expected<std::unique_ptr<llvm::MemoryBuffer>> readStandardInput() {
  auto text = llvm::MemoryBuffer::getSTDIN();
  if (!text)
    return failure("cannot read standard input: " + text.getError().message());
  return std::move(*text);
}

} // namespace ncvet::cli
