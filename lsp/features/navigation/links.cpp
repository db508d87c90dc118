// Names in a document that lead into other files.
#include "lsp/features/navigation/links.h"

#include "lsp/features/navigation/definition.h"

namespace ncvet::lsp {

std::vector<Link> links(Snapshot &snapshot) {
  const Names &names = snapshot.names();
  std::vector<Link> links;
  // Each program is looked for once.
  constexpr size_t mostPrograms = 500;
  std::map<std::pair<NameKind, uint64_t>, std::string> paths;
  for (const Occurrence &one : names.all()) {
    if (!isShared(one) || one.use == NameUse::Definition || one.end <= one.begin)
      continue;
    const std::pair key{one.kind, one.key};
    if (paths.size() >= mostPrograms && !paths.count(key))
      continue;
    const auto [path, fresh] = paths.try_emplace(key);
    if (fresh)
      if (const auto target = targetOf(snapshot, snapshot.unit(), one);
          target && target->unit != &snapshot.unit())
        path->second = target->unit->source.path();
    if (!path->second.empty())
      links.push_back({names.range(one), path->second});
  }
  return links;
}

} // namespace ncvet::lsp
