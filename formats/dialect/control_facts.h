// What a control does where controls differ, as rules ask for it. The keys of `facts` in a table.
#pragma once

#include <string>
#include <vector>

namespace ncvet {

/// About arcs.
struct ArcFacts {
  /// A full circle is not allowed, by its centre neither.
  bool noFullCircle = false;
  /// No helix in a plane that was selected under compensation.
  bool noHelixInNewPlane = false;
  /// A helix goes along the axis that is square to the plane.
  bool checksHelixAxis = false;
  /// A negative R does not select the larger arc safely.
  bool noNegativeRadius = false;
  /// The control stops at a centre word of another plane also when its value is 0.
  bool wrongCentreOfZeroStops = false;
  /// An arc by its centre gives both words of it, and an end, a radius or an angle: one without an
  /// end does not end where it starts.
  bool centreAndEnd = false;
};

/// About radius compensation.
struct CompensationFacts {
  /// Compensation starts and ends with an element of the contour.
  bool approachByElement = false;
  /// The entry move is longer than the radius, not only as long.
  bool entryLonger = false;
  /// Drilling cycles and threads are forbidden under compensation.
  bool forbidsCycles = false;
  /// The same after a soft approach; 0: as elsewhere.
  unsigned idleBlocksAfterApproach = 0;
  /// Moves that leave the plane are not compensated.
  bool onlyInPlane = false;
  /// Moves of the infeed axis alone that may follow each other; 0: they count as idle blocks.
  unsigned infeedMoves = 0;
  /// In a contour that a roughing cycle reads, compensation starts in the first block and ends in
  /// the last.
  bool atEndsOfProfile = false;
  /// The control stops at the smallest damage of the contour.
  bool checksExactly = false;
  /// The control stops after the move that the tool does not fit into.
  bool stopsAfterMove = false;
  /// The same side may not be called again.
  bool sideCalledOnce = false;
  /// Compensation may be switched on in an arc.
  bool entryByArc = false;
  /// The machine's builder chooses the plane at the start.
  bool planeOfBuilder = false;
  /// The cancel code is in a block without a move.
  bool cancelAlone = false;
  /// Compensation is switched on and off in a feed move.
  bool entryByFeed = false;
  /// The manual wants the contour left at rapid, in the block that ends compensation.
  bool exitByRapid = false;
  /// Greatest nose direction that the control has.
  unsigned greatestTip = 9;
  /// A compensated contour of lines that has gone round once reaches its first element.
  bool contourMeetsStart = false;
  /// The control perhaps looks past more blocks without a move than are allowed.
  bool mayPassIdleBlocks = false;
  /// Compensation is for the elements of a contour only.
  bool onlyForContours = false;
  /// Compensation is off where the program stops for the operator.
  bool offAtStops = false;
};

/// About coordinates.
struct CoordinateFacts {
  /// Machine coordinates are for one block: the next one may look as if they were still active.
  bool machineMoveOfOneBlock = false;
  /// A turn of a rotary axis is a move along the developed work.
  bool turnsMoveAlongWork = false;
  /// Words of angle and radius work in the XY plane about the zero point, with a radius of any
  /// sign; under incremental distances not from the zero point.
  bool polarAboutZero = false;
};

/// About chamfers and roundings that a word asks for.
struct CornerFacts {
  /// Blocks without a move may be between the two moves of a corner by a plain letter.
  bool idleBlocksBetween = false;
  /// A corner by a plain letter is between two moves along one axis each.
  bool axisParallel = false;
  /// The sign of a rounding is the direction of its turn, and its size is checked without it.
  bool signIsTurn = false;
  /// The sign of a rounding is the side to which it turns, which must fit the next move.
  bool senseChecked = false;
  /// A size of zero leaves the corner as it is.
  bool zeroIsNone = false;
  /// A move out of the plane is skipped like a block without a move.
  bool skipsMovesOutOfPlane = false;
  /// Corners have a comma, and a plain R in the block of a line does nothing.
  bool commaOnly = false;
  /// A plain R is a corner whose sign is that of the next move.
  bool plainRadiusSigned = true;
  /// The control intersects elements given by angles.
  bool intersects = false;
};

/// About drilling cycles.
struct CycleFacts {
  /// Of a motion code and a cycle in one block the last counts.
  bool lastCodeCounts = false;
  /// Planes that are variables are absolute in every mode, and the depth is below the start.
  bool planesAbsolute = false;
  /// The control drills along Z under G17 only.
  bool drillsUnderG17 = false;
  /// A move in machine coordinates is a place of the cycle.
  bool firesInMachineMoves = false;
  /// The dwell of a drilling cycle counts like that of a dwell code.
  bool dwellInMilliseconds = false;
  /// A tapping cycle leaves its feed per revolution in force.
  bool tapLeavesFeed = false;
  /// The direction of the spindle after a tapping cycle is not certain.
  bool tapLeavesDirection = false;
  /// Cycles take their values from variables, which do nothing without a cycle.
  bool valuesInVariables = false;
  /// The program states the plane before its first cycle.
  bool planeStatedFirst = false;
  /// The moves of a subprogram that is called while a cycle is active are places of the cycle.
  bool firesInCalls = false;
  /// The contour that a milling cycle reads is a closed outline of moves alone, at most this many;
  /// 0: it is no outline.
  unsigned outlineMoves = 0;
  /// The contour that a milling cycle reads begins with G0 and with nothing else.
  bool contourBeginsAtRapid = false;
  /// The call of another cycle takes the place of the one in force.
  bool newCallReplaces = false;
  /// Back boring leaves the bore whatever the return level is.
  bool backBoreAtAnyLevel = false;
};

/// About feed.
struct FeedFacts {
  /// Inverse time feed needs an F in each block that cuts.
  bool inverseTimeInEachBlock = false;
  /// A feed per revolution without a speed stops the control.
  bool perRevolutionNeedsSpeed = false;
  /// The control needs a new F after a change of its unit.
  bool newAfterModeChange = false;
  /// Short moves in a row that ask for a continuous path; 0: not known.
  unsigned shortMoves = 0;
  /// A move below this length, in millimetres, is short.
  double shortMoveLength = 1;
  /// The code that smooths short moves best; empty: no code does, or they are all as good.
  std::string smoothing;
};

/// About how much the control takes.
struct LimitFacts {
  /// Repeats that the control takes at most; 0: any number.
  unsigned repeats = 0;
  /// The count of a repeat is a whole number from 1 on, which a function makes of a real variable.
  bool repeatsWhole = false;
  /// A section that is repeated takes a level of calls.
  bool repeatsTakeLevel = false;
  /// Longest label that the control takes; 0: any length.
  unsigned longestLabel = 0;
  /// Most digits of the tool number of a mill; 0: any number.
  unsigned toolDigits = 0;
  /// Most elements of a section's profile; 0: any number.
  unsigned sectionElements = 0;
  /// Fastest feed of a measuring move, mm/min; 0: any.
  double probeFeed = 0;
  /// Loops have numbers from 1 to this one, each in use once; 0: any.
  unsigned loopNumbers = 0;
  /// Brackets in each other, those of functions counted; 0: any number.
  unsigned bracketDepth = 0;
  /// Most digits of a block number, which begins at 1; 0: any.
  unsigned blockDigits = 0;
  /// Most digits of a length in least increments, which have three decimals; 0: any.
  unsigned lengthDigits = 0;
  /// Levels of macros that call each other; 0: those of all calls.
  unsigned macroDepth = 0;
  /// Most characters of a text between quotation marks; 0: any number.
  unsigned textLength = 0;
  /// Groups of G functions are numbered from 1 to this one; 0: they have no numbers.
  unsigned modeGroups = 0;
  /// Least and greatest number of an alarm that a program raises.
  double leastAlarm = 0;
  double greatestAlarm = 0;
};

/// About texts that a program shows to the operator.
struct MessageFacts {
  /// Words with which a comment begins that is shown: `MSG` of `(MSG, text)`.
  std::vector<std::string> comments;
  /// Those in whose text the names of variables mean their values.
  std::vector<std::string> withValues;
  /// Instructions whose arguments are shown: `MSG` of `MSG("text")`.
  std::vector<std::string> instructions;
  /// Variables: when the program gives one a value, the comment after that is shown.
  std::vector<int> variables;
  /// Those of them that also stop the program as M00 does.
  std::vector<int> stops;
};

/// About measuring.
struct ProbeFacts {
  /// Measurements correct origins by their number.
  bool correctsOrigins = false;
  /// A cycle may use the values of the measurement before.
  bool keepsResults = false;
};

/// About programs and their ends.
struct ProgramFacts {
  /// A called program must return by its own code: a program end in it is a missing return.
  bool noEndInSubprogram = false;
  /// The control also stops at a code that is written twice.
  bool sameCodeTwiceStops = false;
  /// A text without a program number is a program all the same.
  bool fileIsProgram = false;
  /// A second % also ends a program.
  bool tapeMarkEnds = false;
  /// Modes stay active after the end of the program.
  bool modesOutliveEnd = false;
  /// A return code in a main program starts it again, which may be meant.
  bool returnRestarts = false;
  /// Stops, ends, calls and returns share their block with no other M code.
  bool flowCodesAlone = false;
  /// A call takes no words of its block.
  bool callsTakeNoWords = false;
  /// A block that may be skipped changes no mode, whether or not a later block relies on it.
  bool skipKeepsModes = false;
  /// A local call names a block as a jump does.
  bool callsBlocks = false;
  /// Modes and frames that a subprogram sets stay active in its caller.
  bool modesOutliveReturn = false;
  /// An end inside a repeated section ends the program before the repeat.
  bool endCutsRepeats = false;
  /// Sections that are repeated lie inside each other or apart.
  bool repeatsNest = false;
  /// A block that several paths reach states the modes that it needs.
  bool modesStatedAtTargets = false;
  /// Every block has a number.
  bool everyBlockNumbered = false;
  /// The INI file of the machine makes codes.
  bool remapsInIni = false;
  /// Calls with which a program of steps begins that only the control's own editor knows.
  std::vector<std::string> stepHeads;
  /// What the names of files and of units of an archive end in that hold data and no program.
  std::vector<std::string> dataKinds;
  /// Folders in which the control keeps programs, in the order in which it looks for a called one:
  /// `SPF` is also `SPF.DIR`, `.WPD` is the ending of such folders. Empty: it has no folders.
  std::vector<std::string> folders;
};

/// About the spindle.
struct SpindleFacts {
  /// Every S is a speed in revolutions.
  bool inRevolutions = false;
  /// Other codes than those of tapping also stop the spindle.
  bool stoppedByCodes = false;
  /// Programs turn other spindles too, one of which may be the one that cuts.
  bool others = false;
  /// Variables of the control that hold the greatest speed of the spindle.
  std::vector<std::string> limitVariables;
};

/// About how text is read.
struct TextFacts {
  /// Axis letters alone may follow the codes of limits.
  bool bareAxesOfLimits = false;
  /// Codes are whole numbers; 2: codes with decimals are allowed when they exist.
  unsigned wholeCodes = 0;
  /// No blank may be between an address and its number.
  bool noBlanksInWords = false;
  /// The control stops at an opening parenthesis inside a comment.
  bool noNestedComments = false;
  /// Axes that the machine profile does not name are unknown.
  bool axesOfMachine = false;
  /// A tape mark alone, `O1000` and `#1=5` are signs of another control.
  bool isoSignsForeign = false;
  /// The arguments of an instruction have one kind of separator.
  bool oneSeparator = false;
  /// `G83/R` is a manual's name of a variant, no code.
  bool variantNames = false;
  /// Comments for the operator and for the reader are of different kinds.
  bool kindsOfComments = false;
  /// A bracket without its partner is told apart from other errors of an expression.
  bool bracketsApart = false;
  /// Assignments, jumps and loops share their block with no words.
  bool statementsAlone = false;
  /// The brackets of loops share their block with no words.
  bool loopsAlone = false;
  /// Axis letters alone do not name the axes of a reference return.
  bool noBareAxes = false;
  /// Numbers of tools, offsets and speeds take no sign.
  bool noMinusAtNumbers = false;
  /// A % ends the text inside a comment too.
  bool tapeMarkInComments = false;
  /// A program means its lengths with a decimal point, or without one, throughout.
  bool pointsThroughout = false;
};

/// About tools.
struct ToolFacts {
  /// A tool has cutting edges: another edge is another tool, and edge 0 has no offset.
  bool cuttingEdges = false;
  /// The code of a tool change needs a T.
  bool changeNeedsNumber = false;
  /// How the digits of a lathe's T are split into station and offset is set on the machine.
  bool anyDigits = false;
  /// A length offset may stay on until the next one takes its place.
  bool lengthReplaced = false;
};

/// About turning cycles and their profiles.
struct TurningFacts {
  /// An allowance that is left out counts as zero.
  bool missingAllowanceIsZero = false;
  /// Finishing starts at the place where roughing did.
  bool finishStartsAtRoughing = false;
  /// The first block of a profile has its own motion code.
  bool firstBlockHasCode = false;
  /// A facing profile begins in Z only.
  bool faceStartsInZ = false;
  /// A finishing cycle needs a line first too.
  bool finishNeedsLineFirst = false;
  /// The first block of a profile must move.
  bool firstBlockMoves = false;
  /// A contour with pockets has Z in its first block.
  bool pocketsNeedZ = false;
  /// A turning profile begins in X only.
  bool startsInX = false;
  /// A profile holds moves, dwell and compensation only.
  bool profileOfMoves = false;
  /// Roughing looks for its profile only after its own block.
  bool profileAfterCycle = false;
  /// Roughing leaves out corners and angles.
  bool roughingIgnoresCorners = false;
  /// A finishing cycle ignores F, S and T of the profile as well.
  bool finishIgnoresWords = false;
  /// F, S and T of the cycle's block hold for the profile.
  bool ownWordsCount = false;
  /// The control returns one axis after the other.
  bool returnsByAxes = false;
  /// Facing passes can be cones.
  bool facesCones = false;
  /// The control refuses a first cut deeper than the thread.
  bool refusesDeepFirstCut = false;
  /// A thread with another end needs its own lead.
  bool newThreadNeedsLead = false;
  /// E is a lead in inches.
  bool leadInInchesByE = false;
  /// Millimetres per unit of a thread's depth written without a point.
  double threadDepthUnit = 1;
  /// Millimetres per unit of a step written without a point.
  double stepUnit = 1;
  /// Both axes in the first block of a contour are allowed for any contour.
  bool bothAxesFirst = false;
};

/// About numbered variables.
struct VariableFacts {
  /// Greatest number of a variable; 0: not limited.
  unsigned greatest = 0;
  /// Last variable that keeps the value of an earlier program; 0: not known.
  unsigned lastKept = 0;
  /// First variable that the control keeps for itself.
  unsigned reservedFrom = 0;
  /// Last variable that the control keeps for itself; -1: there are none.
  double reservedTo = -1;
  /// Variables have numbers after `#`.
  bool numbered = false;
  /// Variables from this number on do not keep their values; 0: all do.
  unsigned volatileFrom = 0;
  /// A called program writes the variables of its caller.
  bool sharedByPrograms = false;
  /// The tangent of 90 degrees is an error; else it is a large number.
  bool tangentHasPoles = false;
  /// First and last number of each range that has no variables.
  std::vector<int> gaps;
  /// First and last number of each range that the control's own macros write.
  std::vector<int> ofMacros;
  /// First and last number of each range that shows places, which change while the control reads
  /// ahead.
  std::vector<int> shownAhead;
  /// First and last number of each range that shows places in the work's coordinates.
  std::vector<int> workPlaces;
  /// Functions of its family that the control lacks.
  std::vector<std::string> lacksFunctions;
  /// Names of the parts of a frame, which are the last index of its variable.
  std::vector<std::string> frameParts;
};

struct ControlFacts {
  ArcFacts arcs;
  CompensationFacts compensation;
  CoordinateFacts coordinates;
  CornerFacts corners;
  CycleFacts cycles;
  FeedFacts feed;
  LimitFacts limits;
  MessageFacts messages;
  ProbeFacts probe;
  ProgramFacts program;
  SpindleFacts spindle;
  TextFacts text;
  ToolFacts tools;
  TurningFacts turning;
  VariableFacts variables;
};

} // namespace ncvet
