// Crash guard: a crash in one file costs the result of this file, not the run.
#pragma once

#include "formats/text/source.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/Support/PrettyStackTrace.h"

#include <optional>

namespace ncvet {

/// From now on `runGuarded` survives crashes, in all threads. Without it, a crash ends the process.
/// Does nothing under a sanitizer, whose report is worth more.
void enableCrashGuard();

/// Runs `work` and returns nothing; or, after a crash or an exception, what happened and where:
/// "segmentation fault at part.nc:12". What `work` held at that moment is leaked, locks stay
/// locked.
std::optional<std::string> runGuarded(llvm::function_ref<void()> work);

/// While it exists, a crash on this thread is reported at this place. Both are looked at when the
/// crash happens.
class CrashPlace : public llvm::PrettyStackTraceEntry {
public:
  CrashPlace(const SourceFile &file, const uint32_t &offset) : file_(file), offset_(offset) {}
  void print(llvm::raw_ostream &out) const override;

private:
  const SourceFile &file_;
  const uint32_t &offset_;
};

} // namespace ncvet
