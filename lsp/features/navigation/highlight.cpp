// The places of a document that hold the same name as the one under the cursor.
#include "lsp/features/navigation/highlight.h"

namespace ncvet::lsp {

std::vector<Highlight> highlights(Snapshot &snapshot, uint32_t offset) {
  const Names &names = snapshot.names();
  std::vector<Highlight> all;
  if (const Occurrence *const name = names.at(offset))
    for (const uint32_t i : names.same(*name)) {
      const Occurrence &one = names.all()[i];
      all.push_back(
          {names.range(one), one.use == NameUse::Definition || one.use == NameUse::Write});
    }
  return all;
}

} // namespace ncvet::lsp
