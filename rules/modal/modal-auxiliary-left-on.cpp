// A function that comes as an on and off pair is still on at the end of the program.
#include "analyzer/rule/switch_left_on.h"

namespace ncvet {
namespace {

class ModalAuxiliaryLeftOn final : public LeftOnRule {
public:
  ModalAuxiliaryLeftOn() : LeftOnRule("modal-auxiliary-left-on") {}
};

} // namespace
NCVET_RULE(ModalAuxiliaryLeftOn, modal_auxiliary_left_on)
} // namespace ncvet
