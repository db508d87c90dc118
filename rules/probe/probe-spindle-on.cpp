// The spindle turns while a probe touches.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ProbeSpindleOn final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(ProbeSpindleOn, probe_spindle_on)
} // namespace ncvet
