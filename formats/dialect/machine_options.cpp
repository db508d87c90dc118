// Options of machine profiles: what a control leaves to the machine's builder or its owner.
#include "formats/dialect/field.h"
#include "formats/dialect/records.h"

namespace ncvet {

namespace {

using namespace shape;

constexpr llvm::StringLiteral yesNo[] = {"Y", "N"};
constexpr llvm::StringLiteral centres[] = {"absolute", "incremental", "by-mode"};
constexpr llvm::StringLiteral arcsWithoutCentre[] = {"line", "alarm"};
constexpr llvm::StringLiteral cornerForms[] = {"any", "comma", "plain"};
constexpr llvm::StringLiteral tappings[] = {"any", "m29", "always"};
constexpr llvm::StringLiteral codeSets[] = {"A", "B", "C"};
constexpr llvm::StringLiteral pointChoices[] = {"any", "required", "calculator", "increment"};
constexpr llvm::StringLiteral entries[] = {"next", "across"};
constexpr llvm::StringLiteral compensationTools[] = {"of-block"};
constexpr llvm::StringLiteral corners[] = {"arc", "arc-of-next", "lines"};
constexpr llvm::StringLiteral measurings[] = {"A", "B"};
constexpr llvm::StringLiteral unitChoices[] = {"inch", "mm"};
constexpr llvm::StringLiteral coordinateSettings[] = {"fanuc", "haas", "yasnac"};
constexpr llvm::StringLiteral controls[] = {"840D", "840D sl", "828D", "810D", "802D",
                                            "808D", "16i",     "18i",  "21i",  "0i-C",
                                            "0i-D", "0i-F",    "30i",  "31i"};

template <const auto &List>
Names namesOf() {
  return List;
}
template <const auto &List>
constexpr Shape oneOf = name("value", namesOf<List>);

constexpr Shape someText = text;

constexpr Field optionFields[] = {
    elsewhere("acceleration", numberFrom(0),
              "of the axes, mm/s2: for the time that a report gives a program", "3000"),
    elsewhere("agap", oneOf<yesNo>, "the control's AGAP setting", "\"Y\""),
    elsewhere("arcCentres", oneOf<centres>, "meaning of I, J, K", "\"incremental\""),
    elsewhere("arcMacroPlanes", mapOf(someText), "planes of the arc macros, by name",
              R"({"ARC1": "XY"})"),
    elsewhere("arcWords", listOf(someText), "centre words of the arc macros", R"(["I", "J"])"),
    elsewhere("arcWithoutCentre", oneOf<arcsWithoutCentre>,
              "what a FANUC does with an arc that has no centre and no radius (parameter 3403#5)",
              "\"alarm\""),
    elsewhere("automaticDoor", boolean, "the option for M85 and M86", "true"),
    elsewhere("clampedAxes", text, "axes that M10 clamps", "\"C\""),
    elsewhere("codeSet", oneOf<codeSets>,
              "which set of G codes a FANUC lathe uses; unknown: the form of the block decides",
              "\"A\""),
    elsewhere("commonOffsetX", number, "the common offset in X, mm", "0"),
    elsewhere("commonOffsetZ", number, "the common offset in Z, mm", "0"),
    elsewhere("compensationEntry", oneOf<entries>,
              "where the move that builds up compensation ends: beside the start of the next "
              "element, or square to itself",
              "\"across\""),
    elsewhere("compensationTool", oneOf<compensationTools>,
              "the D beside G41 and G42 is the number of a tool and counts for that code alone; "
              "without one it is the tool in use",
              "\"of-block\""),
    elsewhere("control", oneOf<controls>, "which control of the family", "\"802D\""),
    elsewhere("cornerWords", oneOf<cornerForms>,
              "how corner words are written on a FANUC lathe (parameter 3405#4)", "\"comma\""),
    elsewhere("courseProfile", boolean, "the stricter rules of a school course", "true"),
    elsewhere("decimalPoint", oneOf<pointChoices>, "how a number without a point is read",
              "\"calculator\""),
    elsewhere("dialogFolder", text,
              "folder of the pages of the dialogs, with the separator at its end"),
    elsewhere("dialogLines", text,
              "names that the dialog of a part sets, in its order, with blanks between them"),
    elsewhere("dialogs", text,
              "pages of the dialogs with the part that each writes, with blanks between them",
              "\"Drill1.html=DRILL1\""),
    elsewhere("drillAxis", text, "letter of the axis along which cycles drill; only Z is followed",
              "\"Z\""),
    elsewhere("drillParts", mapOf(someText), "names of drill parts with their cycle",
              R"({"DRILL1": "G83"})"),
    elsewhere("gearbox", boolean, "M40 to M45 exist", "false"),
    elsewhere("highPressureCoolant", boolean, "the option for M88 and M89", "true"),
    elsewhere("interferenceCheck", whole(0, 1), "the control's INTERFER parameter", "1"),
    elsewhere("liveTools", boolean, "driven tools are fitted", "false"),
    elsewhere("mCodesPerBlock", whole(0, 100), "how many M codes a block takes", "3"),
    elsewhere("machineModel", text, "SL-20, SL-30, SL-40: gear codes exist on some", "\"SL-20\""),
    elsewhere("macros", boolean, "the option for G65", "true"),
    elsewhere(
        "outsideCorner", oneOf<corners>,
        "how the compensated tool goes round an outside corner: by an arc in the block of the "
        "first or of the second element, or on along straight lines",
        "\"arc\""),
    elsewhere("partFaceZ", number, "Z of the part's face in work coordinates", "0"),
    elsewhere("priorityBlock", text,
              "codes in force when a program starts, by the block that the control runs before it "
              "or by its reset",
              "\"G17 G90 G94 G54\""),
    elsewhere("probeOff", text, "code that switches the probe off", "\"M46\""),
    elsewhere("probeOn", text, "code that switches the probe on", "\"M45\""),
    elsewhere("rearTurret", boolean, "the turret is on the far side of the centre line", "true"),
    elsewhere("rigidTap", oneOf<tappings>,
              "when a FANUC taps rigidly: after M29, or always (parameter 5200#0)", "\"m29\""),
    elsewhere("roughType2", boolean, "roughing of profiles with pockets is fitted", "false"),
    elsewhere("sequenceCall", boolean,
              "`M98 Q` calls a block of the same program (parameter 6005#0)", "false"),
    elsewhere("setting15", boolean, "H and T of a Haas must agree", "true"),
    elsewhere("setting22", number, "by how much a peck is withdrawn to break the chip, mm", "0.5"),
    elsewhere("setting28", boolean, "a cycle of a Haas acts in its own block without X and Y too",
              "false"),
    elsewhere("setting33", oneOf<coordinateSettings>,
              "after which control a Haas reads G52, G92 and a lathe's G50", "\"yasnac\""),
    elsewhere("setting56", boolean, "M30 gives a Haas its default codes back", "false"),
    elsewhere("setting73", number, "by how much a roughing pass is withdrawn, mm", "1"),
    elsewhere("setting86", number, "what the last pass of a thread takes, mm", "0.05"),
    elsewhere("setting95", number, "length of the thread chamfer in leads", "1"),
    elsewhere("setting96", number, "angle of the thread chamfer, degrees", "45"),
    elsewhere("setting99", number, "least depth of a pass of a thread, mm", "0.05"),
    elsewhere("skipFunction", boolean, "the option for G31", "true"),
    elsewhere("spindleEncoder", boolean, "rigid tapping and feed per revolution are possible",
              "true"),
    elsewhere("spindles", whole(1, 20), "how many spindles the machine has", "2"),
    elsewhere("spindleOrientation", boolean, "an oriented stop (M19) is fitted", "true"),
    elsewhere("stockTopZ", number, "top of the stock where `stock` is not given", "0"),
    elsewhere("straightCorner", numberFrom(0),
              "angle in radians up to which two compensated elements meet without a corner",
              "0.05"),
    elsewhere("subSpindle", boolean, "a second spindle is fitted", "false"),
    elsewhere("toolChangeByM6", boolean, "T alone only preselects", "true"),
    elsewhere("toolChangeMinZ", number, "lowest safe Z of a tool change in work coordinates",
              "100"),
    elsewhere("toolChangeTime", numberFrom(0),
              "seconds of a tool change: for the time that a report gives a program", "4.5"),
    elsewhere("toolMeasuring", oneOf<measurings>, "how tools are measured", "\"A\""),
    elsewhere("toolOffsetDigits", whole(1, 4),
              "digits of the offset at the end of a lathe's T (parameter 5028)", "2"),
    elsewhere("twoAxisHead", boolean, "a two-axis head is fitted", "true"),
    elsewhere("unitsG70", oneOf<unitChoices>, "meaning of G70", "\"inch\""),
    elsewhere("userFunctions", boolean, "the option for M51 to M68 and M121 to M128", "true"),
    elsewhere("yAxis", boolean, "a lathe's Y axis is fitted", "false"),
    elsewhere("zeroOnSurface", boolean, "Z0 is on the part's surface", "true"),
};

} // namespace

constexpr Record machineOptionRecord{"option", "options of machine profiles; null: not known",
                                     optionFields, /*laidOver=*/true};

} // namespace ncvet
