// The names of actions, as the tables spell them.
#include "formats/dialect/action.h"

namespace ncvet {

namespace {
constexpr llvm::StringLiteral names[] = {
#define X(name, text) text,
    NCVET_ACTIONS(X)
#undef X
};
} // namespace

llvm::StringRef toString(Action action) { return names[unsigned(action)]; }

std::optional<Action> parseAction(llvm::StringRef text) {
  for (size_t index = 0; index < std::size(names); ++index)
    if (names[index] == text)
      return Action(index);
  return std::nullopt;
}

llvm::ArrayRef<llvm::StringLiteral> actionNames() { return names; }

} // namespace ncvet
