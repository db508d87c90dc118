// The documents that the client has open.
#pragma once

#include "analyzer/check/checker.h"
#include "formats/text/source_set.h"
#include "formats/text/text_change.h"
#include "lsp/protocol/json.h"
#include "lsp/server/text_buffers.h"

#include "llvm/ADT/StringMap.h"

#include <atomic>

namespace ncvet::lsp {

/// What was found out about an open document, carried from each of its versions to the next. Its
/// checks and the features share it, so that a version is followed once: whoever comes first does
/// the work.
struct DocumentMemory {
  std::mutex mutex; ///< of what follows; held while the document is followed
  CheckMemory checks;
  bool prepared = false; ///< see `prepareChecks`
  /// A check of it has taken longer than a question may wait. Safe for several threads.
  std::atomic<bool> takesLong = false;
};

/// One version of an open document. Values of it are kept and handed to other threads.
struct Document {
  std::string uri, path;
  std::string language; ///< id that the client gives it
  int64_t version = 0;
  SharedText text;
  std::shared_ptr<DocumentMemory> memory = nullptr; ///< of all its versions; null: it is not open
};

/// The first version of a text.
SharedText textOf(std::string bytes);

/// Belongs to the thread that takes messages.
class Documents {
public:
  explicit Documents(PositionEncoding encoding) : encoding_(encoding) {}

  void setEncoding(PositionEncoding encoding) { encoding_ = encoding; }
  const Document &open(Document document);
  /// Applies `TextDocumentContentChangeEvent`s; null when no such document is open. Throws
  /// `Json::exception` when they have another form; the document is then as it was.
  const Document *change(llvm::StringRef uri, int64_t version, const Json &changes);
  void close(llvm::StringRef uri);
  /// The next overlay is another object, though the texts are the same.
  void touch() { overlay_.reset(); }
  const Document *find(llvm::StringRef uri) const;
  const std::map<std::string, Document> &all() const { return byUri_; }
  /// The texts of all open documents by path; the same object until one of them changes.
  std::shared_ptr<const SourceSet::Overlay> overlay();

private:
  PositionEncoding encoding_;
  TextBuffers buffers_;
  std::map<std::string, Document> byUri_;
  std::shared_ptr<const SourceSet::Overlay> overlay_;
};

/// `text` with the changes, one after the other. Throws `Json::exception` when they have another
/// form.
SharedText changed(SharedText text, const Json &changes, PositionEncoding encoding,
                   TextBuffers &buffers);

} // namespace ncvet::lsp
