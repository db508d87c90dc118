// The keys of a machine profile: one line for each.
#include "formats/dialect/field.h"
#include "formats/dialect/machine_builder.h"
#include "formats/dialect/records.h"
#include "formats/dialect/vocabulary.h"

namespace ncvet {

namespace {

using namespace shape;

constexpr Shape amount = numberFrom(0), aNumber = number,
                axisPlaces = mapByName(aNumber, "axis", axisNames);

constexpr Field axisFields[] = {
    field<&AxisLimits::min>("min", number, "least machine coordinate, mm or degrees", "-762"),
    field<&AxisLimits::max>("max", number, "greatest machine coordinate", "0"),
};
void checkAxis(JsonReader &in, const Json &value, AxisLimits &limits) {
  if (limits.min && limits.max && *limits.min > *limits.max)
    in.fail(value, "\"min\" is greater than \"max\"");
}

constexpr Field spindleFields[] = {
    field<&MachineProfile::spindleMin>("minSpeed", amount, "slowest speed, 1/min", "20"),
    field<&MachineProfile::spindleMax>("maxSpeed", amount, "fastest speed, 1/min", "8100"),
};
constexpr RecordOf<MachineProfile> spindleRecord{"spindle", "the spindle", spindleFields};

constexpr Field feedFields[] = {
    field<&MachineProfile::feedMax>("max", amount, "fastest feed, mm/min", "16500"),
    field<&MachineProfile::rapid>("rapid", amount, "rapid traverse, mm/min", "25400"),
};
constexpr RecordOf<MachineProfile> feedRecord{"feed", "how fast the axes move", feedFields};

constexpr Field toolFields[] = {
    special<readToolKind>("kind", name("kind of tool", toolKindNames), "kind of tool",
                          "\"endmill\""),
    // A worn tool may be entered below zero.
    field<&ToolData::radius>("radius", number, "of the tool, or of a turning tool's nose, mm", "5"),
    field<&ToolData::length>("length", amount, "mm", "110"),
    field<&ToolData::pitch>("pitch", amount, "of a tap, mm", "1.25"),
    field<&ToolData::width>("width", amount, "of a grooving tool, mm", "3"),
    field<&ToolData::tip>("tip", whole(0, 9), "direction of the nose of a turning tool", "3"),
};

template <size_t Axis, bool Greatest>
void readBound(JsonReader &in, const Json &value, Stock &box) {
  readValue(in, number, value, Greatest ? box.max[Axis] : box.min[Axis]);
}
constexpr Field leastFields[] = {
    special<readBound<0, false>>("X", number, "mm", "0"),
    special<readBound<1, false>>("Y", number, "mm", "0"),
    special<readBound<2, false>>("Z", number, "mm", "-20"),
};
constexpr Field greatestFields[] = {
    special<readBound<0, true>>("X", number, "mm", "100"),
    special<readBound<1, true>>("Y", number, "mm", "60"),
    special<readBound<2, true>>("Z", number, "mm", "0"),
};
constexpr RecordOf<Stock> leastRecord{"least", "the least coordinates of a box", leastFields};
constexpr RecordOf<Stock> greatestRecord{"greatest", "the greatest coordinates of a box",
                                         greatestFields};
constexpr Field boxFields[] = {
    within("min", leastRecord, "the least coordinates; one that is left out is no bound"),
    within("max", greatestRecord, "the greatest coordinates; one that is left out is no bound"),
};
void checkBox(JsonReader &in, const Json &value, Stock &box) {
  for (size_t i = 0; i < box.min.size(); ++i)
    if (box.min[i] && box.max[i] && *box.min[i] > *box.max[i])
      in.fail(value, "\"min\" is greater than \"max\"");
}
constexpr RecordOf<Stock> boxRecord =
    RecordOf<Stock>{"box", "a box in work coordinates", boxFields}.checkedBy<checkBox>();

constexpr Field machineCodeFields[] = {
    elsewhere("summary", text, "what it is, lower case; as `title`", "\"bar feeder, next bar\""),
};
struct MachineCode {};
constexpr RecordOf<MachineCode> machineCodeRecord =
    RecordOf<MachineCode>{"machineCode",
                          "a code of the machine's builder, in the form of a dialect's",
                          machineCodeFields}
        .overlay()
        .basedOn(codeRecord);

constexpr Shape axis = object(axisRecord), tool = object(toolRecord), box = object(boxRecord),
                machineCode = object(machineCodeRecord);

constexpr Field machineFields[] = {
    elsewhere("$schema", text, "for editors", "\"../schema/machine.schema.json\""),
    field<&MachineProfile::dialect>("dialect", text, "dialect of the machine's control",
                                    "\"haas-mill\""),
    special<readAxes>("axes", mapByName(axis, "axis", axisNames),
                      "travel of the axes in machine coordinates",
                      R"({"X": {"min": -762, "max": 0}})"),
    within("spindle", spindleRecord, "the spindle"),
    within("feed", feedRecord, "how fast the axes move"),
    special<readTools>("tools", mapOf(tool, "^[0-9]+$"),
                       "the tools by their numbers; a list that is given is complete",
                       R"({"2": {"kind": "endmill", "radius": 5}})"),
    special<readOffsets>(
        "offsets", mapOf(axisPlaces),
        "machine coordinates of a work offset's origin, by its code; of the place "
        "to which a code leads (`G28`); of the shift over all work offsets (`G92`)",
        R"({"G54": {"X": -400, "Y": -200, "Z": -300}})"),
    field<&MachineProfile::stock>("stock", box, "the stock before machining"),
    field<&MachineProfile::clamps>("clamps", listOf(box),
                                   "boxes that a tool must go round or above: clamps, jaws, bolts"),
    special<checkMachineCodes>(
        "codes", mapOf(machineCode),
        "codes of the machine's builder, laid over the dialect's; one that `does` something "
        "else than the table says replaces the table's entry as a whole",
        R"({"M51": {"does": "none", "summary": "bar feeder, next bar"}})"),
    special<readMachineOptions>("options", object(machineOptionRecord),
                                "options of the machine; which of these a dialect knows is said by "
                                "its table",
                                R"({"liveTools": false})"),
};

} // namespace

constexpr RecordOf<AxisLimits> axisRecord =
    RecordOf<AxisLimits>{"axis", "travel of an axis", axisFields}.checkedBy<checkAxis>();
constexpr RecordOf<ToolData> toolRecord{"tool", "a tool", toolFields};
constexpr RecordOf<MachineProfile> machineRecord{
    "machine", "what a program alone cannot tell about the machine that will run it",
    machineFields};

} // namespace ncvet
