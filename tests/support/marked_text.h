// A document of an editor in a test: a program in which `<|>` marks the places of interest.
#pragma once

#include "lsp/features/snapshot.h"

#include "gtest/gtest.h"

namespace ncvet::test {

/// A snapshot of a program of one control, and where its marks were.
struct MarkedText {
  std::unique_ptr<Session> session;
  std::unique_ptr<lsp::Snapshot> snapshot;
  std::vector<uint32_t> marks; ///< offsets in the text without marks

  lsp::Snapshot *operator->() const { return snapshot.get(); }
  lsp::Snapshot &operator*() const { return *snapshot; }
};

/// `path` says where the text would be; other files are looked for beside it.
inline MarkedText markedText(llvm::StringRef dialect, llvm::StringRef program,
                             llvm::StringRef path = "/nowhere/program.nc") {
  constexpr llvm::StringLiteral mark = "<|>";
  MarkedText marked;
  std::string text;
  while (true) {
    const auto [front, after] = program.split(mark);
    text += front;
    if (front.size() == program.size())
      break;
    marked.marks.push_back(uint32_t(text.size()));
    program = after;
  }
  SessionOptions options;
  options.dialect = dialect.str();
  marked.session = std::make_unique<Session>(std::move(options));
  auto snapshot = lsp::Snapshot::make(*marked.session, nullptr, path,
                                      std::make_shared<const std::string>(std::move(text)));
  if (snapshot)
    marked.snapshot = std::move(*snapshot);
  else
    ADD_FAILURE() << llvm::toString(snapshot.takeError());
  return marked;
}

} // namespace ncvet::test
