// What the spelling of a program's name says.
#include "analyzer/program/program_names.h"

namespace ncvet {

bool isProgramEnding(llvm::StringRef ending, const Dialect &dialect) {
  const auto same = [&](const std::string &one) { return ending.equals_insensitive(one); };
  return llvm::any_of(dialect.mainExtensions, same) ||
         llvm::any_of(dialect.subprogramExtensions, same);
}

llvm::StringRef bareProgramName(llvm::StringRef spelling, const Dialect &dialect) {
  // Only the name counts: the control has folders of its own.
  const size_t slash = spelling.find_last_of("/\\");
  if (slash != llvm::StringRef::npos)
    spelling = spelling.drop_front(slash + 1);
  // `M98 (PART.NC)` names a file.
  if (dialect.lexical.fileInComment) {
    const auto [stem, ending] = spelling.rsplit('.');
    return llvm::any_of(
               dialect.extensions,
               [end = ending](const std::string &one) { return end.equals_insensitive(one); })
               ? stem
               : spelling;
  }
  llvm::StringRef name = spelling;
  if (!name.consume_front_insensitive("_N_"))
    return spelling;
  const auto [stem, ending] = name.rsplit('_');
  return stem.empty() || !isProgramEnding(ending, dialect) ? spelling : stem;
}

} // namespace ncvet
