// Globs of a configuration, compiled once.
#include "analyzer/setup/globs.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/Support/Path.h"

namespace ncvet {

Globs::Globs(llvm::ArrayRef<std::string> globs) {
  for (llvm::StringRef glob : globs) {
    if (!glob.contains('/')) {
      add(ofNames_, glob);
      continue;
    }
    const std::string whole = glob.endswith("/") ? (glob + "*").str() : glob.str();
    glob = whole;
    add(ofPaths_, glob);
    if (glob.consume_front("**/"))
      add(ofPaths_, glob);
  }
}

void Globs::add(std::vector<llvm::GlobPattern> &patterns, llvm::StringRef text) {
  texts_.push_back(text.str());
  if (auto pattern = llvm::GlobPattern::create(texts_.back()))
    patterns.push_back(std::move(*pattern));
  else
    llvm::consumeError(pattern.takeError());
}

bool Globs::match(llvm::StringRef path) const {
  const auto matchesIn = [](const std::vector<llvm::GlobPattern> &patterns, llvm::StringRef text) {
    return llvm::any_of(patterns,
                        [&](const llvm::GlobPattern &pattern) { return pattern.match(text); });
  };
  return matchesIn(ofPaths_, path) || matchesIn(ofNames_, llvm::sys::path::filename(path));
}

} // namespace ncvet
