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

llvm::ArrayRef<llvm::StringLiteral> actionNames() { return spellings; }

} // namespace ncvet
