// Exact stop or a limit of look-ahead is still on at the end of the program.
#include "analyzer/left_on.h"

namespace ncvet {
namespace {

class ModalPathModeLeftOn final : public LeftOnRule {
public:
  ModalPathModeLeftOn() : LeftOnRule("modal-path-mode-left-on") {}
};

} // namespace
NCVET_RULE(ModalPathModeLeftOn, modal_path_mode_left_on)
} // namespace ncvet
