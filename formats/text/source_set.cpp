// Source set: adding and finding the files of one run.
#include "formats/text/source_set.h"

#include <cassert>

namespace ncvet {

llvm::Expected<const SourceFile *> SourceSet::open(llvm::StringRef path, llvm::StringRef display) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (overlay_) {
    const auto text = overlay_->find(path.str());
    if (text != overlay_->end()) {
      files_.push_back(
          SourceFile::fromShared(static_cast<FileId>(files_.size()), display, text->second, path));
      return files_.back().get();
    }
  }
  auto file = SourceFile::open(static_cast<FileId>(files_.size()), path, display);
  if (!file)
    return file.takeError();
  files_.push_back(std::move(*file));
  return files_.back().get();
}

const SourceFile &SourceSet::add(llvm::StringRef display, llvm::StringRef text,
                                 llvm::StringRef path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  files_.push_back(SourceFile::fromText(static_cast<FileId>(files_.size()), display, text, path));
  return *files_.back();
}

const SourceFile &SourceSet::add(llvm::StringRef display, SharedText text, llvm::StringRef path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  files_.push_back(
      SourceFile::fromShared(static_cast<FileId>(files_.size()), display, std::move(text), path));
  return *files_.back();
}

const SourceFile &SourceSet::get(FileId id) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  assert(id < files_.size() && "an id of another set");
  return *files_[id];
}

size_t SourceSet::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return files_.size();
}

} // namespace ncvet
