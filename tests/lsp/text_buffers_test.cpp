// The memory of texts goes from one that nobody holds any more to the next, and never from another.
#include "lsp/server/text_buffers.h"

#include <gtest/gtest.h>

namespace ncvet::lsp {
namespace {

constexpr size_t longText = 1u << 20;

TEST(TextBuffersTest, ATextThatIsStillHeldKeepsItsMemory) {
  TextBuffers buffers;
  const auto first = buffers.take(longText);
  first->assign(longText, 'a');
  const auto second = buffers.take(longText);
  second->assign(longText, 'b');
  EXPECT_NE(first->data(), second->data());
  EXPECT_EQ(*first, std::string(longText, 'a'));
}

TEST(TextBuffersTest, WhatIsLetGoOfIsUsedAgain) {
  TextBuffers buffers;
  auto first = buffers.take(longText);
  const char *const memory = first->data();
  first->assign(longText, 'a');
  const std::weak_ptr<std::string> seen = first;
  first.reset();
  EXPECT_TRUE(seen.expired()) << "who looks for the old text must not find the new one";
  const auto next = buffers.take(longText + 100);
  EXPECT_EQ(next->data(), memory);
  EXPECT_TRUE(next->empty());
}

TEST(TextBuffersTest, AShortTextDoesNotHoldTheMemoryOfALongOne) {
  TextBuffers buffers;
  buffers.take(8 * longText);
  EXPECT_LT(buffers.take(longText)->capacity(), 2 * longText);
  EXPECT_LT(buffers.take(10)->capacity(), 100u);
}

TEST(TextBuffersTest, TextsMayOutliveTheBuffers) {
  std::shared_ptr<std::string> text;
  {
    TextBuffers buffers;
    text = buffers.take(longText);
  }
  text->assign(longText, 'a');
  EXPECT_EQ(text->size(), longText);
}

} // namespace
} // namespace ncvet::lsp
