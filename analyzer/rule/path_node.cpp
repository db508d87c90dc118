// The path to a block, in words.
#include "analyzer/rule/path_node.h"

#include "formats/text/formatted.h"

#include "llvm/ADT/STLExtras.h"

#include <set>
#include <tuple>

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
  case PathNode::Kind::Holds:
    return "when this condition holds";
  case PathNode::Kind::NoJump:
    return "when this condition does not hold";
  case PathNode::Kind::LoopRuns:
    return "when this loop runs";
  case PathNode::Kind::LoopEnded:
    return "when this loop has ended";
  case PathNode::Kind::Skip:
    return "when block skip is on";
  case PathNode::Kind::LoopPass:
    return "in a later pass of this loop";
  }
  return {};
}

/// A macro that looks at all its arguments first makes a row of conditions that do not hold: of a
/// longer one the first and the last are named, and how many are between.
constexpr size_t mostInRow = 3;

void shortenRows(std::vector<PathStep> &steps, llvm::ArrayRef<PathNode::Kind> kinds) {
  std::vector<PathStep> kept;
  for (size_t begin = 0; begin < steps.size();) {
    size_t end = begin + 1;
    if (kinds[begin] == PathNode::Kind::NoJump)
      while (end < steps.size() && kinds[end] == PathNode::Kind::NoJump)
        ++end;
    if (end - begin > mostInRow) {
      kept.push_back(std::move(steps[begin]));
      kept.back().message =
          formatted("when neither this condition nor the {0} after it hold", end - begin - 2);
      begin = end - 1;
    }
    for (; begin < end; ++begin)
      kept.push_back(std::move(steps[begin]));
  }
  steps = std::move(kept);
}

} // namespace

std::vector<PathStep> stepsOf(const PathNode *path) {
  std::vector<const PathNode *> nodes;
  for (const PathNode *node = path; node; node = node->before)
    nodes.push_back(node);
  std::vector<PathStep> steps;
  std::vector<PathNode::Kind> kinds;
  // A loop that is run for real takes the same way in every pass: said once, it explains as much.
  static constexpr PathNode::Kind repeatedKinds[] = {PathNode::Kind::Jump, PathNode::Kind::Holds,
                                                     PathNode::Kind::LoopRuns,
                                                     PathNode::Kind::LoopPass};
  std::set<std::tuple<PathNode::Kind, FileId, uint32_t>> said;
  for (const PathNode *node : llvm::reverse(nodes))
    if (!llvm::is_contained(repeatedKinds, node->kind) ||
        said.insert({node->kind, node->range.file, node->range.begin}).second) {
      steps.push_back({node->range, describe(*node)});
      kinds.push_back(node->kind);
    }
  shortenRows(steps, kinds);
  return steps;
}

} // namespace ncvet
