// What the rewritings have in common after which the program does exactly the same.
#pragma once

#include "lsp/features/writing/selection.h"

namespace ncvet::lsp {

/// Gathers the edits of one rewriting, and proves it at the end.
class Rewriter {
protected:
  Rewriter(Selection &selection, const char *title)
      : selection_(selection), dialect_(selection.dialect()), text_(selection.snapshot().text()) {
    result_.title = title;
  }

  /// False, to be returned.
  bool refuse(std::string why) {
    result_.refused = std::move(why);
    return false;
  }
  bool isRefused() const { return !result_.refused.empty(); }
  void edit(uint32_t begin, uint32_t end, std::string text) {
    result_.edits.push_back({{selection_.snapshot().source().id(), begin, end}, std::move(text)});
  }
  /// In the place of all selected blocks.
  void replaceBlocks(std::string text) {
    edit(selection_.blocks().front().begin, selection_.blocks().back().end, std::move(text));
  }
  /// Writes a program into a file of its own.
  void create(std::string path, std::string text) {
    result_.file = NewFile{std::move(path), std::move(text)};
  }
  Rewriting finish() {
    if (isRefused()) {
      result_.edits.clear();
      result_.file.reset();
    }
    selection_.proveSame(result_);
    return std::move(result_);
  }

  Selection &selection_;
  const Dialect &dialect_;
  const llvm::StringRef text_;
  Rewriting result_;
};

} // namespace ncvet::lsp
