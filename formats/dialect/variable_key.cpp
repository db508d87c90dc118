// Keys of variables: a number for each variable of a program, with a name or without.
#include "formats/dialect/variable_key.h"

#include "llvm/Support/xxhash.h"

#include <string>

namespace ncvet {

uint64_t variableKey(llvm::StringRef name) {
  return firstNamedVariable | (llvm::xxHash64(name.upper()) & (firstNamedVariable - 1));
}

uint64_t sharedVariableKey(llvm::StringRef name) {
  return firstSharedVariable | (llvm::xxHash64(name.upper()) & (firstSharedVariable - 1));
}

uint64_t controlVariableKey(llvm::StringRef spelling) {
  uint64_t number = 0;
  return spelling.getAsInteger(10, number) ? sharedVariableKey(spelling) : number;
}

uint64_t elementKey(uint64_t array, int64_t index) {
  const uint64_t key[] = {array, uint64_t(index)};
  return firstNamedVariable | (llvm::xxHash64({reinterpret_cast<const char *>(key), sizeof key}) &
                               (firstNamedVariable - 1));
}

} // namespace ncvet
