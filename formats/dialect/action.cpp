// The names of actions, as the tables spell them.
#include "formats/dialect/action.h"

namespace ncvet {

namespace {
constexpr llvm::StringLiteral spellings[] = {
#define X(name, text) text,
    NCVET_ACTIONS(X)
#undef X
};
} // namespace

llvm::StringRef toString(Action action) { return spellings[unsigned(action)]; }

std::optional<Action> parseAction(llvm::StringRef text) {
  for (size_t index = 0; index < std::size(spellings); ++index)
    if (spellings[index] == text)
      return Action(index);
  return std::nullopt;
}

llvm::ArrayRef<llvm::StringLiteral> actionNames() { return spellings; }

} // namespace ncvet
