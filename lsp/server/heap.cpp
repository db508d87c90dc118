// The settings of glibc's heap.
#include "lsp/server/heap.h"

#include <malloc.h>

namespace ncvet::lsp {

void keepFreedMemory() {
  constexpr int keptBytes = 1 << 30;
  ::mallopt(M_MMAP_THRESHOLD, keptBytes);
  ::mallopt(M_TRIM_THRESHOLD, keptBytes);
}

void giveBackFreeMemory() { ::malloc_trim(0); }

} // namespace ncvet::lsp
