// A cycle withdraws to a level inside the work.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CycleRetractTooLow final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(CycleRetractTooLow, cycle_retract_too_low)
} // namespace ncvet
