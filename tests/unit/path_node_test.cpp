// The steps of a path as they are shown.
#include "analyzer/rule/path_node.h"

#include <gmock/gmock.h>

#include <deque>

namespace ncvet {
namespace {

using testing::ElementsAre;

/// The messages of a path of these kinds, one node in each line.
std::vector<std::string> shown(const std::vector<PathNode::Kind> &kinds) {
  std::deque<PathNode> nodes;
  for (const PathNode::Kind kind : kinds) {
    PathNode node;
    node.kind = kind;
    node.range = {FileId(0), uint32_t(10 * nodes.size()), uint32_t(10 * nodes.size() + 5)};
    node.before = nodes.empty() ? nullptr : &nodes.back();
    nodes.push_back(node);
  }
  std::vector<std::string> messages;
  for (const PathStep &step : stepsOf(nodes.empty() ? nullptr : &nodes.back()))
    messages.push_back(step.message);
  return messages;
}

TEST(PathSteps, ARowOfConditionsIsItsFirstAndItsLast) {
  using Kind = PathNode::Kind;
  EXPECT_THAT(shown({Kind::Call, Kind::NoJump, Kind::NoJump, Kind::NoJump}),
              ElementsAre("called here", "when this condition does not hold",
                          "when this condition does not hold",
                          "when this condition does not hold"));
  EXPECT_THAT(shown({Kind::NoJump, Kind::NoJump, Kind::NoJump, Kind::NoJump, Kind::NoJump,
                     Kind::Jump, Kind::NoJump}),
              ElementsAre("when neither this condition nor the 3 after it hold",
                          "when this condition does not hold", "when this jump is taken",
                          "when this condition does not hold"));
}

/// Each pass of a loop takes the same way.
TEST(PathSteps, WhatALoopDoesInEachPassIsSaidOnce) {
  using Kind = PathNode::Kind;
  std::deque<PathNode> nodes;
  for (unsigned pass = 0; pass < 3; ++pass)
    for (const auto &[kind, begin] : {std::pair(Kind::Holds, 40u), std::pair(Kind::LoopPass, 90u)})
      nodes.push_back(
          {kind, {FileId(0), begin, begin + 5}, 0, 1, nodes.empty() ? nullptr : &nodes.back()});
  std::vector<std::string> messages;
  for (const PathStep &step : stepsOf(&nodes.back()))
    messages.push_back(step.message);
  EXPECT_THAT(messages, ElementsAre("when this condition holds", "in a later pass of this loop"));
}

} // namespace
} // namespace ncvet
