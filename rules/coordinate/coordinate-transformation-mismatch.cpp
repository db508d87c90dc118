// A transformation that does not fit the machine.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CoordinateTransformationMismatch final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(CoordinateTransformationMismatch, coordinate_transformation_mismatch)
} // namespace ncvet
