// Keeps the memory of long texts: how much of it, and for which.
#include "lsp/server/text_buffers.h"

#include <algorithm>

namespace ncvet::lsp {

namespace {

/// Of a shorter text a version costs little.
constexpr size_t shortText = 256u << 10;
/// Free ones that are kept: as many as come back before one is asked for.
constexpr size_t mostFree = 2;

/// A text may grow by this much before its memory is too small.
size_t roomFor(size_t size) { return size + size / 16; }

} // namespace

std::shared_ptr<std::string> TextBuffers::take(size_t size) {
  if (size < shortText)
    return std::make_shared<std::string>();
  std::unique_ptr<std::string> buffer;
  {
    const std::lock_guard<std::mutex> lock(free_->mutex);
    auto &free = free_->buffers;
    const auto fits = std::find_if(free.begin(), free.end(), [&](const auto &one) {
      return one->capacity() >= size && one->capacity() <= 2 * roomFor(size);
    });
    if (fits != free.end()) {
      buffer = std::move(*fits);
      free.erase(fits);
    } else {
      free.clear(); // of another document, or of this one when it was shorter
    }
  }
  if (!buffer) {
    buffer = std::make_unique<std::string>();
    buffer->reserve(roomFor(size));
  }
  buffer->clear();
  return {buffer.release(), [free = free_](std::string *text) {
            std::unique_ptr<std::string> unused(text);
            const std::lock_guard<std::mutex> lock(free->mutex);
            if (free->buffers.size() < mostFree)
              free->buffers.push_back(std::move(unused));
          }};
}

} // namespace ncvet::lsp
