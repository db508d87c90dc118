// A cycle that was written for another tool.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class CycleToolMismatch final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(CycleToolMismatch, cycle_tool_mismatch)
} // namespace ncvet
