// `ncvet init`: writes a `.ncvet.json` to begin with.
#include "analyzer/cli/config_command.h"
#include "analyzer/cli/output.h"
#include "analyzer/setup/input_files.h"
#include "formats/text/file_uri.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"
#include "llvm/Support/Process.h"
#include "llvm/Support/raw_ostream.h"
#include <nlohmann/json.hpp>

#include <cstdio>

namespace ncvet::cli {

namespace {

namespace path = llvm::sys::path;

/// Programs that are looked at: enough to know a folder.
constexpr size_t mostLookedAt = 500;
/// Answers that are no control, before it is given up.
constexpr unsigned mostAnswers = 3;

/// How many programs of a folder are surely for which control.
struct FoundControls {
  std::map<std::string, size_t> sure;
  size_t programs = 0;

  /// The control of the folder; empty when there are several or none is sure.
  std::string only() const { return sure.size() == 1 ? sure.begin()->first : ""; }
};

FoundControls controlsIn(const std::string &folder) {
  FoundControls found;
  Session session{SessionOptions()};
  const std::vector<std::string> folders = {folder};
  for (const Input &input : collectInputs(folders, session).files) {
    if (found.programs == mostLookedAt)
      break;
    ++found.programs;
    SourceSet sources;
    auto file = sources.open(input.path, input.display);
    if (!file) {
      llvm::consumeError(file.takeError());
      continue;
    }
    auto setup = session.setup(input.path, (*file)->text());
    if (setup && setup->detected && setup->sure)
      ++found.sure[setup->dialect->id];
    llvm::consumeError(setup.takeError());
  }
  return found;
}

void tell(const FoundControls &found) {
  llvm::raw_ostream &out = llvm::errs();
  out << found.programs << (found.programs == 1 ? " program" : " programs");
  llvm::StringRef separator = ": ";
  for (const auto &[dialect, count] : found.sure) {
    out << separator << count << " surely for " << dialect;
    separator = ", ";
  }
  out << '\n';
}

/// Asks on the terminal; `usual` is the answer of an empty line. An error when no answer is a
/// control.
llvm::Expected<std::string> askDialect(const std::string &usual) {
  for (unsigned asked = 0; asked < mostAnswers; ++asked) {
    llvm::errs() << "control, or auto to find it out for each program [" << usual << "]: ";
    char line[128];
    if (!std::fgets(line, sizeof line, stdin))
      return usual;
    const std::string answer = llvm::StringRef(line).trim().str();
    if (answer.empty() || answer == "auto")
      return answer.empty() ? usual : answer;
    llvm::Error wrong = checkDialect(answer);
    if (!wrong)
      return answer;
    llvm::errs() << llvm::toString(std::move(wrong)) << '\n';
  }
  return failure("no control was named");
}

/// The schema that was installed with this program; its name elsewhere.
std::string schemaOf() {
  llvm::SmallString<256> file = llvm::StringRef(llvm::sys::fs::getMainExecutable(nullptr, nullptr));
  path::remove_filename(file);
  path::append(file, "..", "share", "ncvet", "schema");
  path::append(file, "config.schema.json");
  path::remove_dots(file, /*remove_dot_dot=*/true);
  return llvm::sys::fs::exists(file) ? uriOfPath(file)
                                     : "https://ncvet.invalid/schema/config.schema.json";
}

} // namespace

InitCommand::InitCommand() : Command("init", "write a .ncvet.json to begin with") {
  options.section("Options");
  options.add("--dialect", &dialect_, "the control; else it is found out, and asked on a terminal")
      .valued("ID", "the id of a control, which `ncvet dialects` lists");
  options.add("--machine", &machine_, "profile of the machine").valued("FILE");
  options.add("--profile", &profile_, "selection of rules: recommended (default), strict, all")
      .valued("NAME")
      .among({"recommended", "strict", "all"});
  options.add("--force", &force_, "replace a .ncvet.json that is there");
  options.operands("FOLDER", folder_, 0, 1);
}

int InitCommand::run() {
  const std::string folder = folder_.empty() ? "." : folder_.front();
  if (!llvm::sys::fs::is_directory(folder))
    return fail(folder + " is no folder");
  llvm::SmallString<256> file = llvm::StringRef(folder);
  path::append(file, configFileName);
  path::remove_dots(file);
  if (llvm::sys::fs::exists(file) && !force_)
    return fail(file + " is there already; --force replaces it");
  std::string dialect = dialect_;
  if (dialect.empty()) {
    const FoundControls found = controlsIn(folder);
    tell(found);
    dialect = found.only().empty() ? "auto" : found.only();
    if (llvm::sys::Process::StandardInIsUserInput()) {
      auto answer = askDialect(dialect);
      if (!answer)
        return fail(answer.takeError());
      dialect = std::move(*answer);
    }
  } else if (dialect != "auto" && !llvm::StringRef(dialect).endswith(".json")) {
    if (llvm::Error wrong = checkDialect(dialect))
      return fail(std::move(wrong));
  }
  nlohmann::ordered_json json = {{"$schema", schemaOf()},
                                 {"extends", profile_.empty() ? "recommended" : profile_},
                                 {"dialect", dialect}};
  if (!machine_.empty())
    json["machine"] = machine_;
  const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
  if (llvm::Error wrong =
          writeFile(std::string(file), [&](llvm::raw_ostream &out) { out << text << '\n'; }))
    return fail(std::move(wrong));
  // What it says is looked at as a check would do.
  if (auto config = loadConfig(file); !config)
    return fail(config.takeError());
  llvm::outs() << "wrote " << file << ": "
               << (dialect == "auto" ? "the control is found out for each program" : dialect)
               << '\n';
  return exitClean;
}

} // namespace ncvet::cli
