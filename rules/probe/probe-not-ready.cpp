// A measuring cycle without a probe.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ProbeNotReady final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(ProbeNotReady, probe_not_ready)
} // namespace ncvet
