// Globs of a configuration, compiled once.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/Support/GlobPattern.h"

#include <deque>
#include <string>
#include <vector>

namespace ncvet {

/// Matches paths relative to the configuration's folder, with `/` as separator. A glob without `/`
/// matches the name alone; one that ends in `/` matches a folder and what it holds; `*` matches any
/// text. Texts that are no globs match nothing.
class Globs {
public:
  explicit Globs(llvm::ArrayRef<std::string> globs);
  Globs(Globs &&) = default;
  Globs(const Globs &) = delete;
  bool match(llvm::StringRef path) const;

private:
  void add(std::vector<llvm::GlobPattern> &patterns, llvm::StringRef text);

  std::deque<std::string> texts_; ///< patterns look into them, so that they stay where they are
  std::vector<llvm::GlobPattern> ofNames_, ofPaths_;
};

} // namespace ncvet
