// Reads what the findings of a check are compared with: nothing is checked when that fails.
#include "analyzer/cli/comparisons.h"

#include "formats/text/failure.h"
#include "formats/text/read_file.h"

namespace ncvet::cli {

llvm::Expected<Comparisons> Comparisons::load(const CheckRequest &request) {
  Comparisons compared;
  if (!request.baseline.empty()) {
    auto baseline = Baseline::load(request.baseline);
    if (!baseline)
      return baseline.takeError();
    compared.baseline = std::move(*baseline);
  }
  if (!request.changedSince.empty()) {
    auto changes = ChangedLines::since(request.changedSince);
    if (!changes)
      return changes.takeError();
    compared.changes = std::move(*changes);
  }
  if (request.changedLines.empty())
    return compared;
  auto patch = request.changedLines == "-" ? readStandardInput() : readFile(request.changedLines);
  if (!patch)
    return patch.takeError();
  auto changes = ChangedLines::ofPatch((*patch)->getBuffer(), projectRoot());
  if (!changes)
    return failure("--changed-lines " + llvm::Twine(request.changedLines) + ": " +
                   llvm::toString(changes.takeError()));
  compared.changes = std::move(*changes);
  return compared;
}

} // namespace ncvet::cli
