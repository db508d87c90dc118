// A shift, rotation, scaling, mirror or polar mode is still on at the end of the program.
#include "analyzer/rule/switch_left_on.h"

namespace ncvet {
namespace {

class CoordinateFrameLeftOn final : public LeftOnRule {
public:
  CoordinateFrameLeftOn() : LeftOnRule("coordinate-frame-left-on") {}
};

} // namespace
NCVET_RULE(CoordinateFrameLeftOn, coordinate_frame_left_on)
} // namespace ncvet
