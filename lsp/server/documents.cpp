// The documents that the client has open, and how changes are applied to them.
#include "lsp/server/documents.h"

namespace ncvet::lsp {

std::shared_ptr<const std::string> changed(std::shared_ptr<const std::string> text,
                                           const Json &changes, PositionEncoding encoding) {
  for (const Json &change : changes) {
    const auto &replacement = change.at("text").get_ref<const std::string &>();
    if (!change.contains("range")) {
      text = std::make_shared<const std::string>(replacement);
      continue;
    }
    const auto source = SourceFile::fromShared(0, "", text);
    Positions positions(*source, encoding);
    const auto [begin, end] = offsetsOf(positions, change["range"]);
    auto next = std::make_shared<std::string>();
    next->reserve(text->size() - (end - begin) + replacement.size());
    next->append(*text, 0, begin).append(replacement).append(*text, end, std::string::npos);
    text = std::move(next);
  }
  return text;
}

const Document &Documents::open(Document document) {
  overlay_.reset();
  const std::string uri = document.uri;
  return byUri_[uri] = std::move(document);
}

const Document *Documents::change(llvm::StringRef uri, int64_t version, const Json &changes) {
  const auto found = byUri_.find(uri.str());
  if (found == byUri_.end())
    return nullptr;
  Document &document = found->second;
  document.text = changed(document.text, changes, encoding_);
  document.version = version;
  overlay_.reset();
  return &document;
}

void Documents::close(llvm::StringRef uri) {
  byUri_.erase(uri.str());
  overlay_.reset();
}

const Document *Documents::find(llvm::StringRef uri) const {
  const auto found = byUri_.find(uri.str());
  return found == byUri_.end() ? nullptr : &found->second;
}

std::shared_ptr<const SourceSet::Overlay> Documents::overlay() {
  if (!overlay_) {
    auto texts = std::make_shared<SourceSet::Overlay>();
    for (const auto &[uri, document] : byUri_)
      (*texts)[document.path] = document.text;
    overlay_ = std::move(texts);
  }
  return overlay_;
}

} // namespace ncvet::lsp
