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
/// text. Texts that are no globs match nothing. The time for a match is that of comparing the glob
/// at each place of the path at most.
class Globs {
public:
  explicit Globs(llvm::ArrayRef<std::string> globs);
  Globs(Globs &&) = default;
  Globs(const Globs &) = delete;
  bool match(llvm::StringRef path) const;

private:
  /// A part of a glob without `*`, which takes a fixed number of characters.
  struct Piece {
    size_t length;
    llvm::GlobPattern pattern;
  };
  /// The parts between its stars. With a star at an end the part there is empty.
  using Glob = std::vector<Piece>;

  void add(std::vector<Glob> &globs, llvm::StringRef text);
  static bool matches(const Glob &glob, llvm::StringRef text);

  std::deque<std::string> texts_; ///< patterns look into them, so that they stay where they are
  std::vector<Glob> ofNames_, ofPaths_;
};

/// `file` as seen from `folder`, with `/` as separator; its whole path when it is not below it. A
/// `/` at its end stays.
std::string pathBelow(llvm::StringRef folder, llvm::StringRef file);

} // namespace ncvet
