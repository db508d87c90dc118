// A matrix that the control cannot use.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CoordinateMatrixInvalid final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(CoordinateMatrixInvalid, coordinate_matrix_invalid)
} // namespace ncvet
