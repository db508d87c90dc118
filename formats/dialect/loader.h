// Reads dialect tables and machine profiles from JSON, checks them and resolves `extends`.
#pragma once

#include "formats/dialect/machine.h"
#include "formats/dialect/ruleset_files.h"

#include "llvm/Support/Error.h"

#include <functional>
#include <memory>

namespace ncvet {

/// Finds the text of a dialect by id; none when there is no such dialect.
using DialectSource =
    std::function<std::optional<std::pair<std::string /*file name*/, llvm::StringRef>>(
        llvm::StringRef id)>;

/// The built-in tables (`builtinRulesetFiles`).
DialectSource builtinDialects();

/// Loads dialect `id` with all that it extends. An unknown key or a bad value is an error that
/// names file, line and what was expected there.
llvm::Expected<std::shared_ptr<const Dialect>> loadDialect(llvm::StringRef id,
                                                           const DialectSource &source);

/// Reads a machine profile; `name` is the file name for messages.
llvm::Expected<MachineProfile> parseMachineProfile(llvm::StringRef name, llvm::StringRef text);

/// `dialect` with the profile's codes and options laid over it.
llvm::Expected<std::shared_ptr<const Dialect>> overlay(std::shared_ptr<const Dialect> dialect,
                                                       llvm::StringRef name, llvm::StringRef text);

/// What detection and `ncvet dialects` need of a dialect, without loading its codes.
struct DialectSummary {
  std::string id, title, extends;
  bool abstract = false;
  std::vector<DetectMark> detect;
  std::vector<std::string> extensions; ///< file name endings that speak for it, without the dot
};
/// The head of one table.
llvm::Expected<DialectSummary> summarize(llvm::StringRef name, llvm::StringRef text);
/// All dialects of the built-in tables, sorted by id.
std::vector<DialectSummary> listDialects();

} // namespace ncvet
