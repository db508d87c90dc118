// Places of several files as locations of the protocol.
#pragma once

#include "formats/text/source_set.h"
#include "lsp/protocol/json.h"

namespace ncvet::lsp {

/// Converts places in the files of one set. Keeps the positions of each file; one thread at a time.
class Places {
public:
  Places(const SourceSet &sources, PositionEncoding encoding)
      : sources_(sources), encoding_(encoding) {}

  Positions &of(FileId file);
  std::string uri(FileId file) const;
  /// The client writes the URI of a file so; there are several ways to escape one.
  void spell(FileId file, std::string uri) { spelled_[file] = std::move(uri); }
  Json range(SourceRange range) { return rangeJson(of(range.file), range); }
  Json location(SourceRange place) { return {{"uri", uri(place.file)}, {"range", range(place)}}; }
  /// Edits by URI, as `WorkspaceEdit.changes` has them.
  Json changes(llvm::ArrayRef<TextEdit> edits);

private:
  const SourceSet &sources_;
  PositionEncoding encoding_;
  std::map<FileId, Positions> positions_;
  std::map<FileId, std::string> spelled_;
};

} // namespace ncvet::lsp
