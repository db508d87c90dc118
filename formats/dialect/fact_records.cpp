// The keys of `facts`: what a control does where controls differ, for rules.
#include "formats/dialect/field.h"
#include "formats/dialect/records.h"

namespace ncvet {

namespace {

using namespace shape;

constexpr Field arcsFields[] = {
    flag<&ArcFacts::noFullCircle>("noFullCircle",
                                  "a full circle is not allowed, by its centre neither"),
    flag<&ArcFacts::noHelixInNewPlane>("noHelixInNewPlane",
                                       "no helix in a plane that was selected under compensation"),
    flag<&ArcFacts::checksHelixAxis>("checksHelixAxis",
                                     "a helix goes along the axis that is square to the plane"),
    flag<&ArcFacts::noNegativeRadius>("noNegativeRadius",
                                      "a negative R does not select the larger arc safely"),
    flag<&ArcFacts::wrongCentreOfZeroStops>(
        "wrongCentreOfZeroStops",
        "the control stops at a centre word of another plane also when its value is 0"),
    flag<&ArcFacts::centreAndEnd>(
        "centreAndEnd", "an arc by its centre gives both words of it, and an end, a radius or an "
                        "angle: one without an end does not end where it starts"),
};
constexpr RecordOf<ArcFacts> arcsRecord =
    RecordOf<ArcFacts>{"facts of arcs", "what holds for arcs", arcsFields}.overlay();

constexpr Field compensationFields[] = {
    flag<&CompensationFacts::approachByElement>(
        "approachByElement", "compensation starts and ends with an element of the contour"),
    flag<&CompensationFacts::entryLonger>(
        "entryLonger", "the entry move is longer than the radius, not only as long"),
    flag<&CompensationFacts::forbidsCycles>(
        "forbidsCycles", "drilling cycles and threads are forbidden under compensation"),
    field<&CompensationFacts::idleBlocksAfterApproach>(
        "idleBlocksAfterApproach", wholeNumber, "the same after a soft approach; 0: as elsewhere",
        "5"),
    flag<&CompensationFacts::onlyInPlane>("onlyInPlane",
                                          "moves that leave the plane are not compensated"),
    field<&CompensationFacts::infeedMoves>(
        "infeedMoves", wholeNumber,
        "moves of the infeed axis alone that may follow each other; 0: they count as idle blocks",
        "1"),
    flag<&CompensationFacts::atEndsOfProfile>(
        "atEndsOfProfile", "in a contour that a roughing cycle reads, compensation starts in the "
                           "first block and ends in the last"),
    flag<&CompensationFacts::checksExactly>(
        "checksExactly", "the control stops at the smallest damage of the contour"),
    flag<&CompensationFacts::stopsAfterMove>(
        "stopsAfterMove", "the control stops after the move that the tool does not fit into"),
    flag<&CompensationFacts::sideCalledOnce>("sideCalledOnce",
                                             "the same side may not be called again"),
    flag<&CompensationFacts::entryByArc>("entryByArc", "compensation may be switched on in an arc"),
    flag<&CompensationFacts::planeOfBuilder>(
        "planeOfBuilder", "the machine's builder chooses the plane at the start"),
    flag<&CompensationFacts::cancelAlone>("cancelAlone",
                                          "the cancel code is in a block without a move"),
    flag<&CompensationFacts::entryByFeed>("entryByFeed",
                                          "compensation is switched on and off in a feed move"),
    flag<&CompensationFacts::exitByRapid>(
        "exitByRapid", "the manual wants the contour left at rapid, in the block that ends "
                       "compensation"),
    field<&CompensationFacts::greatestTip>("greatestTip", wholeNumber,
                                           "greatest nose direction that the control has", "8"),
    flag<&CompensationFacts::contourMeetsStart>(
        "contourMeetsStart",
        "a compensated contour of lines that has gone round once reaches its first element"),
    flag<&CompensationFacts::mayPassIdleBlocks>(
        "mayPassIdleBlocks",
        "the control perhaps looks past more blocks without a move than are allowed"),
    flag<&CompensationFacts::onlyForContours>("onlyForContours",
                                              "compensation is for the elements of a contour only"),
    flag<&CompensationFacts::offAtStops>(
        "offAtStops", "compensation is off where the program stops for the operator"),
};
constexpr RecordOf<CompensationFacts> compensationRecord =
    RecordOf<CompensationFacts>{"facts of compensation", "what holds for radius compensation",
                                compensationFields}
        .overlay();

constexpr Field coordinatesFields[] = {
    flag<&CoordinateFacts::machineMoveOfOneBlock>("machineMoveOfOneBlock",
                                                  "machine coordinates are for one block: the next "
                                                  "one may look as if they were still active"),
    flag<&CoordinateFacts::turnsMoveAlongWork>(
        "turnsMoveAlongWork", "a turn of a rotary axis is a move along the developed work"),
    flag<&CoordinateFacts::polarAboutZero>(
        "polarAboutZero", "words of angle and radius work in the XY plane about the zero point, "
                          "with a radius of any sign; as increments not from the zero point"),
};
constexpr RecordOf<CoordinateFacts> coordinatesRecord =
    RecordOf<CoordinateFacts>{"facts of coordinates", "what holds for coordinates",
                              coordinatesFields}
        .overlay();

constexpr Field cornersFields[] = {
    flag<&CornerFacts::idleBlocksBetween>(
        "idleBlocksBetween",
        "blocks without a move may be between the two moves of a corner by a plain letter"),
    flag<&CornerFacts::axisParallel>(
        "axisParallel", "a corner by a plain letter is between two moves along one axis each"),
    flag<&CornerFacts::signIsTurn>(
        "signIsTurn",
        "the sign of a rounding is the direction of its turn, and its size is checked without it"),
    flag<&CornerFacts::senseChecked>(
        "senseChecked",
        "the sign of a rounding is the side to which it turns, which must fit the next move"),
    flag<&CornerFacts::zeroIsNone>("zeroIsNone", "a size of zero leaves the corner as it is"),
    flag<&CornerFacts::skipsMovesOutOfPlane>(
        "skipsMovesOutOfPlane", "a move out of the plane is skipped like a block without a move"),
    flag<&CornerFacts::commaOnly>(
        "commaOnly", "corners have a comma, and a plain R in the block of a line does nothing"),
    flag<&CornerFacts::plainRadiusSigned>(
        "plainRadiusSigned", "a plain R is a corner whose sign is that of the next move", "false"),
    flag<&CornerFacts::intersects>("intersects", "the control intersects elements given by angles"),
};
constexpr RecordOf<CornerFacts> cornersRecord =
    RecordOf<CornerFacts>{"facts of corners",
                          "what holds for chamfers and roundings that a word asks for",
                          cornersFields}
        .overlay();

constexpr Field cyclesFields[] = {
    flag<&CycleFacts::lastCodeCounts>("lastCodeCounts",
                                      "of a motion code and a cycle in one block the last counts"),
    flag<&CycleFacts::planesAbsolute>(
        "planesAbsolute",
        "planes that are variables are absolute in every mode, and the depth is below the start"),
    flag<&CycleFacts::drillsUnderG17>("drillsUnderG17",
                                      "the control drills along Z under G17 only"),
    flag<&CycleFacts::firesInMachineMoves>("firesInMachineMoves",
                                           "a move in machine coordinates is a place of the cycle"),
    flag<&CycleFacts::dwellInMilliseconds>(
        "dwellInMilliseconds", "the dwell of a drilling cycle counts like that of a dwell code"),
    flag<&CycleFacts::tapLeavesFeed>("tapLeavesFeed",
                                     "a tapping cycle leaves its feed per revolution in force"),
    flag<&CycleFacts::tapLeavesDirection>(
        "tapLeavesDirection", "the direction of the spindle after a tapping cycle is not certain"),
    flag<&CycleFacts::valuesInVariables>(
        "valuesInVariables",
        "cycles take their values from variables, which do nothing without a cycle"),
    flag<&CycleFacts::planeStatedFirst>("planeStatedFirst",
                                        "the program states the plane before its first cycle"),
    field<&CycleFacts::outlineMoves>(
        "outlineMoves", wholeNumber,
        "the contour that a milling cycle reads is a closed outline of moves alone, at most this "
        "many; 0: it is no outline",
        "40"),
    flag<&CycleFacts::contourBeginsAtRapid>(
        "contourBeginsAtRapid",
        "the contour that a milling cycle reads begins with G0 and with nothing else"),
    flag<&CycleFacts::backBoreAtAnyLevel>(
        "backBoreAtAnyLevel", "back boring leaves the bore whatever the return level is"),
    flag<&CycleFacts::newCallReplaces>(
        "newCallReplaces", "the call of another cycle takes the place of the one in force"),
    flag<&CycleFacts::firesInCalls>(
        "firesInCalls",
        "the moves of a subprogram that is called while a cycle is active are places of the cycle"),
};
constexpr RecordOf<CycleFacts> cyclesRecord =
    RecordOf<CycleFacts>{"facts of cycles", "what holds for drilling cycles", cyclesFields}
        .overlay();

constexpr Field feedFields[] = {
    flag<&FeedFacts::inverseTimeInEachBlock>(
        "inverseTimeInEachBlock", "inverse time feed needs an F in each block that cuts"),
    flag<&FeedFacts::perRevolutionNeedsSpeed>(
        "perRevolutionNeedsSpeed", "a feed per revolution without a speed stops the control"),
    flag<&FeedFacts::newAfterModeChange>("newAfterModeChange",
                                         "the control needs a new F after a change of its unit"),
    field<&FeedFacts::shortMoves>(
        "shortMoves", wholeNumber,
        "short moves in a row that ask for a continuous path; 0: not known", "8"),
    field<&FeedFacts::shortMoveLength>("shortMoveLength", numberFrom(0),
                                       "a move below this length, in millimetres, is short", "0.5"),
    field<&FeedFacts::smoothing>("smoothing", text,
                                 "the code that smooths short moves best; left out: no code does, "
                                 "or they are all as good",
                                 "\"G69\""),
};
constexpr RecordOf<FeedFacts> feedRecord =
    RecordOf<FeedFacts>{"facts of feed", "what holds for feed", feedFields}.overlay();

constexpr Field limitsFields[] = {
    flag<&LimitFacts::repeatsTakeLevel>("repeatsTakeLevel",
                                        "a section that is repeated takes a level of calls"),
    flag<&LimitFacts::repeatsWhole>("repeatsWhole",
                                    "the count of a repeat is a whole number from 1 on, which a "
                                    "function makes of a real variable"),
    field<&LimitFacts::repeats>("repeats", wholeNumber,
                                "repeats that the control takes at most; 0: any number", "9999"),
    field<&LimitFacts::longestLabel>("longestLabel", wholeNumber,
                                     "longest label that the control takes; 0: any length", "32"),
    field<&LimitFacts::toolDigits>("toolDigits", wholeNumber,
                                   "most digits of the tool number of a mill; 0: any number", "4"),
    field<&LimitFacts::sectionElements>("sectionElements", wholeNumber,
                                        "most elements of a section's profile; 0: any number",
                                        "100"),
    field<&LimitFacts::probeFeed>("probeFeed", number,
                                  "fastest feed of a measuring move, mm/min; 0: any", "100"),
    field<&LimitFacts::loopNumbers>(
        "loopNumbers", wholeNumber,
        "loops have numbers from 1 to this one, each in use once; 0: any", "3"),
    field<&LimitFacts::bracketDepth>(
        "bracketDepth", wholeNumber,
        "brackets in each other, those of functions counted; 0: any number", "5"),
    field<&LimitFacts::blockDigits>("blockDigits", wholeNumber,
                                    "most digits of a block number, which begins at 1; 0: any",
                                    "8"),
    field<&LimitFacts::lengthDigits>(
        "lengthDigits", wholeNumber,
        "most digits of a length in least increments, which have three decimals; 0: any", "8"),
    field<&LimitFacts::macroDepth>("macroDepth", wholeNumber,
                                   "levels of macros that call each other; 0: those of all calls",
                                   "5"),
    field<&LimitFacts::textLength>("textLength", wholeNumber,
                                   "most characters of a text between quotation marks; 0: any",
                                   "200"),
    field<&LimitFacts::modeGroups>(
        "modeGroups", wholeNumber,
        "groups of G functions are numbered from 1 to this one; 0: they have no numbers", "64"),
    field<&LimitFacts::leastAlarm>("leastAlarm", number,
                                   "least number of an alarm that a program raises", "1"),
    field<&LimitFacts::greatestAlarm>("greatestAlarm", number,
                                      "greatest number of an alarm that a program raises; 0: any",
                                      "999"),
};
constexpr RecordOf<LimitFacts> limitsRecord =
    RecordOf<LimitFacts>{"facts of limits", "what holds for how much the control takes",
                         limitsFields}
        .overlay();

constexpr Field probeFields[] = {
    flag<&ProbeFacts::correctsOrigins>("correctsOrigins",
                                       "measurements correct origins by their number"),
    flag<&ProbeFacts::keepsResults>("keepsResults",
                                    "a cycle may use the values of the measurement before"),
};
constexpr RecordOf<ProbeFacts> probeRecord =
    RecordOf<ProbeFacts>{"facts of measuring", "what holds for measuring", probeFields}.overlay();

constexpr Field spindleFields[] = {
    flag<&SpindleFacts::inRevolutions>("inRevolutions", "every S is a speed in revolutions"),
    flag<&SpindleFacts::stoppedByCodes>("stoppedByCodes",
                                        "other codes than those of tapping also stop the spindle"),
    flag<&SpindleFacts::others>(
        "others", "programs turn other spindles too, one of which may be the one that cuts"),
    field<&SpindleFacts::limitVariables>(
        "limitVariables", texts,
        "variables of the control that hold the greatest speed of the spindle",
        R"(["$SC_SPIND_MAX_VELO_LIMS"])"),
};
constexpr RecordOf<SpindleFacts> spindleRecord =
    RecordOf<SpindleFacts>{"facts of the spindle", "what holds for the spindle", spindleFields}
        .overlay();

constexpr Field toolsFields[] = {
    flag<&ToolFacts::cuttingEdges>(
        "cuttingEdges",
        "a tool has cutting edges: another edge is another tool, and edge 0 has no offset"),
    flag<&ToolFacts::changeNeedsNumber>("changeNeedsNumber", "the code of a tool change needs a T"),
    flag<&ToolFacts::anyDigits>("anyDigits", "how the digits of a lathe's T are split into station "
                                             "and offset is set on the machine"),
    flag<&ToolFacts::lengthReplaced>(
        "lengthReplaced", "a length offset may stay on until the next one takes its place"),
};
constexpr RecordOf<ToolFacts> toolsRecord =
    RecordOf<ToolFacts>{"facts of tools", "what holds for tools", toolsFields}.overlay();

constexpr Field turningFields[] = {
    flag<&TurningFacts::missingAllowanceIsZero>("missingAllowanceIsZero",
                                                "an allowance that is left out counts as zero"),
    flag<&TurningFacts::finishStartsAtRoughing>("finishStartsAtRoughing",
                                                "finishing starts at the place where roughing did"),
    flag<&TurningFacts::firstBlockHasCode>("firstBlockHasCode",
                                           "the first block of a profile has its own motion code"),
    flag<&TurningFacts::faceStartsInZ>("faceStartsInZ", "a facing profile begins in Z only"),
    flag<&TurningFacts::finishNeedsLineFirst>("finishNeedsLineFirst",
                                              "a finishing cycle needs a line first too"),
    flag<&TurningFacts::firstBlockMoves>("firstBlockMoves",
                                         "the first block of a profile must move"),
    flag<&TurningFacts::pocketsNeedZ>("pocketsNeedZ",
                                      "a contour with pockets has Z in its first block"),
    flag<&TurningFacts::startsInX>("startsInX", "a turning profile begins in X only"),
    flag<&TurningFacts::profileOfMoves>("profileOfMoves",
                                        "a profile holds moves, dwell and compensation only"),
    flag<&TurningFacts::profileAfterCycle>(
        "profileAfterCycle", "roughing looks for its profile only after its own block"),
    flag<&TurningFacts::roughingIgnoresCorners>("roughingIgnoresCorners",
                                                "roughing leaves out corners and angles"),
    flag<&TurningFacts::finishIgnoresWords>(
        "finishIgnoresWords", "a finishing cycle ignores F, S and T of the profile as well"),
    flag<&TurningFacts::ownWordsCount>("ownWordsCount",
                                       "F, S and T of the cycle's block hold for the profile"),
    flag<&TurningFacts::returnsByAxes>("returnsByAxes",
                                       "the control returns one axis after the other"),
    flag<&TurningFacts::facesCones>("facesCones", "facing passes can be cones"),
    flag<&TurningFacts::refusesDeepFirstCut>(
        "refusesDeepFirstCut", "the control refuses a first cut deeper than the thread"),
    flag<&TurningFacts::newThreadNeedsLead>("newThreadNeedsLead",
                                            "a thread with another end needs its own lead"),
    flag<&TurningFacts::leadInInchesByE>("leadInInchesByE", "E is a lead in inches"),
    field<&TurningFacts::threadDepthUnit>(
        "threadDepthUnit", number,
        "millimetres per unit of a thread's depth written without a point", "0.001"),
    field<&TurningFacts::stepUnit>(
        "stepUnit", number, "millimetres per unit of a step written without a point", "0.001"),
    flag<&TurningFacts::bothAxesFirst>(
        "bothAxesFirst", "both axes in the first block of a contour are allowed for any contour"),
};
constexpr RecordOf<TurningFacts> turningRecord =
    RecordOf<TurningFacts>{"facts of turning", "what holds for turning cycles and their profiles",
                           turningFields}
        .overlay();

constexpr Field factFields[] = {
    field<&ControlFacts::arcs>("arcs", object(arcsRecord), "arcs"),
    field<&ControlFacts::compensation>("compensation", object(compensationRecord),
                                       "radius compensation"),
    field<&ControlFacts::coordinates>("coordinates", object(coordinatesRecord), "coordinates"),
    field<&ControlFacts::corners>("corners", object(cornersRecord),
                                  "chamfers and roundings that a word asks for"),
    field<&ControlFacts::cycles>("cycles", object(cyclesRecord), "drilling cycles"),
    field<&ControlFacts::feed>("feed", object(feedRecord), "feed"),
    field<&ControlFacts::limits>("limits", object(limitsRecord), "how much the control takes"),
    field<&ControlFacts::messages>("messages", object(messageFactRecord),
                                   "texts that a program shows to the operator"),
    field<&ControlFacts::probe>("probe", object(probeRecord), "measuring"),
    field<&ControlFacts::program>("program", object(programFactRecord), "programs and their ends"),
    field<&ControlFacts::spindle>("spindle", object(spindleRecord), "the spindle"),
    field<&ControlFacts::text>("text", object(textFactRecord), "how text is read"),
    field<&ControlFacts::tools>("tools", object(toolsRecord), "tools"),
    field<&ControlFacts::turning>("turning", object(turningRecord),
                                  "turning cycles and their profiles"),
    field<&ControlFacts::variables>("variables", object(variableFactRecord), "numbered variables"),
};

} // namespace

constexpr RecordOf<ControlFacts> factRecord =
    RecordOf<ControlFacts>{"facts", "what the control does where controls differ, for rules",
                           factFields}
        .overlay();

} // namespace ncvet
