// The tool's tip or a turned work offset is still followed where the machine must move by itself.
#include "analyzer/rule/switch_left_on.h"

namespace ncvet {
namespace {

class CoordinateTcpLeftOn final : public LeftOnRule {
public:
  CoordinateTcpLeftOn() : LeftOnRule("coordinate-tcp-left-on") {}
};

} // namespace
NCVET_RULE(CoordinateTcpLeftOn, coordinate_tcp_left_on)
} // namespace ncvet
