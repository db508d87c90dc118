// One version of a document: its setup, and its text cut into blocks.
#include "lsp/features/snapshot.h"

#include "analyzer/program/block_reading.h"
#include "lsp/features/names.h"

#include <algorithm>

namespace ncvet::lsp {

Snapshot::Snapshot(FileSetup setup, std::shared_ptr<const SourceSet::Overlay> open)
    : setup_(std::move(setup)), sources_(std::move(open)) {}

Snapshot::~Snapshot() = default;

const Names &Snapshot::names(const FileUnit &unit) {
  auto &names = names_[unit.source.id()];
  if (!names)
    names = std::make_unique<Names>(unit);
  return *names;
}

llvm::Expected<std::unique_ptr<Snapshot>>
Snapshot::make(Session &session, std::shared_ptr<const SourceSet::Overlay> open,
               llvm::StringRef path, SharedText text, CheckMemory *memory) {
  auto setup = session.setup(path, *text.bytes);
  if (!setup)
    return setup.takeError();
  std::unique_ptr<Snapshot> snapshot(new Snapshot(std::move(*setup), std::move(open)));
  snapshot->source_ = &snapshot->sources_.add(path, text, path);
  const FileSetup &known = snapshot->setup_;
  snapshot->project_ = std::make_unique<Project>(snapshot->sources_, known.dialect, *known.machine,
                                                 known.config->searchFolders, known.folders);
  snapshot->unit_ = &snapshot->project_->unit(
      *snapshot->source_, memory ? memory->scanFor(known, *snapshot->source_, text) : nullptr);
  return snapshot;
}

FileUnit *Snapshot::unitOf(llvm::StringRef path) {
  for (size_t i = 0; i < sources_.size(); ++i)
    if (sources_.get(FileId(i)).path() == path)
      return &project_->unit(sources_.get(FileId(i)));
  auto opened = sources_.open(path);
  if (opened)
    return &project_->unit(**opened);
  llvm::consumeError(opened.takeError());
  return nullptr;
}

llvm::ArrayRef<uint32_t> Snapshot::blocks() {
  if (!blocks_.empty())
    return blocks_;
  for (const Block &block : ncvet::blocks(*unit_->reader))
    blocks_.push_back(block.begin);
  return blocks_;
}

llvm::ArrayRef<CompensatedContour> Snapshot::contours() {
  if (!contours_)
    contours_ = compensatedContours(*project_, *unit_, setup_.limits);
  return *contours_;
}

void Snapshot::readAt(uint32_t offset, Block &block) {
  if (!dialect().lexical.blocksSpanLines)
    return readBlockAt(source(), *unit_->reader, offset, block);
  const llvm::ArrayRef<uint32_t> all = blocks();
  const auto next = std::upper_bound(all.begin(), all.end(), offset);
  if (next == all.begin()) {
    block.clear();
    block.begin = block.end = block.next = offset;
    return;
  }
  unit_->reader->read(*(next - 1), block);
}

} // namespace ncvet::lsp
