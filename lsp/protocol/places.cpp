// Places of several files as locations of the protocol.
#include "lsp/protocol/places.h"

#include "formats/text/file_uri.h"

namespace ncvet::lsp {

Positions &Places::of(FileId file) {
  return positions_.try_emplace(file, sources_.get(file), encoding_).first->second;
}

std::string Places::uri(FileId file) const {
  const auto spelled = spelled_.find(file);
  return spelled == spelled_.end() ? uriOfPath(sources_.get(file).path()) : spelled->second;
}

Json Places::changes(llvm::ArrayRef<TextEdit> edits) {
  std::map<FileId, std::vector<TextEdit>> byFile;
  for (const TextEdit &edit : edits)
    byFile[edit.range.file].push_back(edit);
  Json changes = Json::object();
  for (const auto &[file, ofFile] : byFile)
    changes[uri(file)] = editsJson(of(file), ofFile);
  return changes;
}

} // namespace ncvet::lsp
