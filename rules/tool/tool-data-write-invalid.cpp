// Tool data that the control does not take.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ToolDataWriteInvalid final : public Rule {
public:
  /// The tables say when; what they say is reported for it.
  void listen(Subscriptions &) override {}
};

} // namespace
NCVET_RULE(ToolDataWriteInvalid, tool_data_write_invalid)
} // namespace ncvet
