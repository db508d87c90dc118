// The results of measuring go on being written.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ProbeOutputLeftOpen final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(ProbeOutputLeftOpen, probe_output_left_open)
} // namespace ncvet
