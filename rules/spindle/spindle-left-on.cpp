// A live tool that still turns at a tool change or at the program's end.
#include "analyzer/left_on.h"

namespace ncvet {
namespace {

class SpindleLeftOn final : public LeftOnRule {
public:
  SpindleLeftOn() : LeftOnRule("spindle-left-on") {}
};

} // namespace
NCVET_RULE(SpindleLeftOn, spindle_left_on)
} // namespace ncvet
