// A measuring cycle with values that it cannot work with.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ProbeParameterInvalid final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(ProbeParameterInvalid, probe_parameter_invalid)
} // namespace ncvet
