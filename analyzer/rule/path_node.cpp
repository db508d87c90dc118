// The path to a block, in words.
#include "analyzer/rule/path_node.h"

#include "llvm/ADT/STLExtras.h"

#include <set>

namespace ncvet {

namespace {

std::string describe(const PathNode &node) {
  switch (node.kind) {
  case PathNode::Kind::Call:
    return "called here";
  case PathNode::Kind::ModalCall:
    return "after this block the modal call runs its program";
  case PathNode::Kind::Jump:
    return "when this jump is taken";
  case PathNode::Kind::NoJump:
    return "when this condition does not hold";
  case PathNode::Kind::Skip:
    return "when block skip is on";
  case PathNode::Kind::LoopPass:
    return "in a later pass of this loop";
  }
  return {};
}

} // namespace

std::vector<PathStep> stepsOf(const PathNode *path) {
  std::vector<const PathNode *> nodes;
  for (const PathNode *node = path; node; node = node->before)
    nodes.push_back(node);
  std::vector<PathStep> steps;
  // A loop that is run for real takes the same jump in every pass: said once, it explains as much.
  std::set<std::pair<FileId, uint32_t>> jumps;
  for (const PathNode *node : llvm::reverse(nodes))
    if (node->kind != PathNode::Kind::Jump ||
        jumps.insert({node->range.file, node->range.begin}).second)
      steps.push_back({node->range, describe(*node)});
  return steps;
}

} // namespace ncvet
