// The memory of long texts, used again from one version to the next.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace ncvet::lsp {

/// Every edit makes a new text, and fresh memory for a long one costs a page fault every 4 KiB,
/// which takes longer than the copy. Texts that nobody holds any more give theirs to later ones.
class TextBuffers {
public:
  /// An empty text with room for `size` bytes.
  std::shared_ptr<std::string> take(size_t size);

private:
  /// Outlives the texts, which come back to it on whatever thread lets go of them.
  struct Free {
    std::mutex mutex;
    std::vector<std::unique_ptr<std::string>> buffers;
  };
  std::shared_ptr<Free> free_ = std::make_shared<Free>();
};

} // namespace ncvet::lsp
