// The mode in which blocks are data for the control is not ended.
#include "analyzer/rule/switch_left_on.h"

namespace ncvet {
namespace {

class CoordinateDataSettingNotClosed final : public LeftOnRule {
public:
  CoordinateDataSettingNotClosed() : LeftOnRule("coordinate-data-setting-not-closed") {}
};

} // namespace
NCVET_RULE(CoordinateDataSettingNotClosed, coordinate_data_setting_not_closed)
} // namespace ncvet
