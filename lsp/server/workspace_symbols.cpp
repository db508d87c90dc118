// Names of all programs of the workspace: which files have to be read again, and what matches.
#include "lsp/server/workspace_symbols.h"

#include "analyzer/setup/input_files.h"
#include "lsp/features/navigation/symbols.h"
#include "lsp/server/bindings.h"

namespace ncvet::lsp {

namespace {

constexpr size_t mostSymbols = 1000; ///< more nobody looks through
constexpr size_t filesOfPart = 64;   ///< of an answer that comes in parts

} // namespace

const std::vector<WorkspaceSymbols::Entry> &WorkspaceSymbols::entriesOf(const CheckJob &base,
                                                                        const std::string &path) {
  const auto [place, isNew] = files_.try_emplace(path);
  Kept &kept = place->second;
  FileStamp stamp = stampOf(path, *base.overlay);
  if (!isNew && kept.stamp == stamp)
    return kept.entries;
  kept = {std::move(stamp), {}};
  std::shared_ptr<const std::string> text = kept.stamp.open;
  if (!text) {
    auto file = llvm::MemoryBuffer::getFile(path, /*IsText=*/false);
    if (!file)
      return kept.entries;
    text = std::make_shared<const std::string>((*file)->getBuffer().str());
  }
  auto snapshot = Snapshot::make(*base.session, base.overlay, path, std::move(text));
  if (!snapshot) {
    llvm::consumeError(snapshot.takeError());
    return kept.entries;
  }
  Places places((*snapshot)->project().sources(), base.encoding);
  for (NamedSymbol &symbol : workspaceSymbols(**snapshot, "")) {
    Json json = {{"name", symbol.name},
                 {"kind", symbolKind(symbol.kind)},
                 {"location", places.location(symbol.selection)}};
    if (!symbol.container.empty())
      json["containerName"] = symbol.container;
    kept.entries.push_back({std::move(symbol.name), std::move(json)});
  }
  return kept.entries;
}

Json WorkspaceSymbols::search(const CheckJob &base, llvm::ArrayRef<std::string> folders,
                              llvm::StringRef query, WorkDone &work, PartialAnswer &parts,
                              const std::atomic<bool> &cancelled) {
  if (base.session != session_) {
    session_ = base.session;
    files_.clear();
  }
  Json list = Json::array();
  size_t found = 0;
  const std::vector<Input> files = collectInputs(folders, *base.session).files;
  for (size_t i = 0; i < files.size() && found < mostSymbols && !cancelled; ++i) {
    for (const Entry &entry : entriesOf(base, files[i].path))
      if (llvm::StringRef(entry.name).contains_insensitive(query)) {
        list.push_back(entry.symbol);
        ++found;
      }
    work.report(i + 1, files.size());
    if (parts.isWanted() && !list.empty() && i % filesOfPart == filesOfPart - 1)
      parts.send(std::exchange(list, Json::array()));
  }
  return list;
}

} // namespace ncvet::lsp
