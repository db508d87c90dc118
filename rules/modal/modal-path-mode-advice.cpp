// A corner mode that does not suit the work.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ModalPathModeAdvice final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(ModalPathModeAdvice, modal_path_mode_advice)
} // namespace ncvet
