// Coolant is still on at the end of the program.
#include "analyzer/rule/switch_left_on.h"

namespace ncvet {
namespace {

class ModalCoolantLeftOn final : public LeftOnRule {
public:
  ModalCoolantLeftOn() : LeftOnRule("modal-coolant-left-on") {}
};

} // namespace
NCVET_RULE(ModalCoolantLeftOn, modal_coolant_left_on)
} // namespace ncvet
