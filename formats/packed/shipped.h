// The tables that come with the program, out of their packed form: the same as out of their JSON.
#pragma once

#include "formats/dialect/config_file.h"
#include "formats/dialect/loader.h"

namespace ncvet {

/// Built-in dialect `id`, as `loadDialect` gives it.
llvm::Expected<std::shared_ptr<const Dialect>> loadShipped(llvm::StringRef id);

/// All built-in dialects, as `listDialects` gives them.
const std::vector<DialectSummary> &shippedDialects();

/// The built-in table of detection, as `loadDetection` gives it.
const DetectFile &shippedDetection();

/// By pattern of a mark: what `neededTexts` gives.
const llvm::StringMap<std::vector<std::string>> &shippedNeededTexts();

} // namespace ncvet
