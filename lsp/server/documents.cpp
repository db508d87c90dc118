// The documents that the client has open, and how changes are applied to them.
#include "lsp/server/documents.h"

namespace ncvet::lsp {

SharedText textOf(std::string bytes) {
  SharedText text(std::make_shared<const std::string>(std::move(bytes)));
  auto lines = std::make_shared<LineIndex>(*text.bytes);
  lines->countAll();
  text.lines = std::move(lines);
  return text;
}

SharedText changed(SharedText text, const Json &changes, PositionEncoding encoding,
                   TextBuffers &buffers) {
  for (const Json &each : changes) {
    const auto &replacement = each.at("text").get_ref<const std::string &>();
    if (!each.contains("range")) {
      text = textOf(replacement);
      continue;
    }
    const auto source = SourceFile::fromShared(0, "", text);
    Positions positions(*source, encoding);
    const auto [begin, end] = offsetsOf(positions, each["range"]);
    const std::string &before = *text.bytes;
    const auto bytes = buffers.take(before.size() - (end - begin) + replacement.size());
    bytes->append(before, 0, begin).append(replacement).append(before, end, std::string::npos);
    const TextChange change{begin, end, uint32_t(replacement.size())};
    auto lines = std::make_shared<LineIndex>(*bytes, *text.lines, begin, end, change.added);
    lines->countAll();
    SharedText next(bytes);
    next.lines = std::move(lines);
    next.history = TextHistory::with(text, change);
    text = std::move(next);
  }
  return text;
}

const Document &Documents::open(Document document) {
  overlay_.reset();
  const std::string uri = document.uri;
  document.memory = std::make_shared<DocumentMemory>();
  return byUri_[uri] = std::move(document);
}

const Document *Documents::change(llvm::StringRef uri, int64_t version, const Json &changes) {
  const auto found = byUri_.find(uri.str());
  if (found == byUri_.end())
    return nullptr;
  Document &document = found->second;
  document.text = changed(document.text, changes, encoding_, buffers_);
  document.version = version;
  overlay_.reset();
  return &document;
}

void Documents::close(llvm::StringRef uri) {
  byUri_.erase(uri.str());
  overlay_.reset();
  buffers_ = TextBuffers();
}

const Document *Documents::find(llvm::StringRef uri) const {
  const auto found = byUri_.find(uri.str());
  return found == byUri_.end() ? nullptr : &found->second;
}

std::shared_ptr<const SourceSet::Overlay> Documents::overlay() {
  if (!overlay_) {
    auto texts = std::make_shared<SourceSet::Overlay>();
    for (const auto &[uri, document] : byUri_)
      (*texts)[document.path] = document.text.bytes;
    overlay_ = std::move(texts);
  }
  return overlay_;
}

} // namespace ncvet::lsp
