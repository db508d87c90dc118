// The keys of `facts` that tell how programs, their texts and their variables are read, for rules.
#include "formats/dialect/field.h"
#include "formats/dialect/records.h"

namespace ncvet {

namespace {

using namespace shape;

constexpr Field messagesFields[] = {
    field<&MessageFacts::comments>("comments", texts,
                                   "words with which a comment begins that the operator sees",
                                   R"(["MSG"])"),
    field<&MessageFacts::withValues>("withValues", texts,
                                     "those in whose text the names of variables mean their values",
                                     R"(["DEBUG"])"),
    field<&MessageFacts::instructions>(
        "instructions", texts, "instructions whose arguments the operator sees", R"(["MSG"])"),
    field<&MessageFacts::variables>(
        "variables", listOf(wholeNumber),
        "variables: the comment after a value that is given to one of them is shown",
        "[3000, 3006]"),
    field<&MessageFacts::stops>("stops", listOf(wholeNumber),
                                "those of them that stop the program as M00 does", "[3006]"),
};

constexpr Field programFields[] = {
    flag<&ProgramFacts::noEndInSubprogram>(
        "noEndInSubprogram",
        "a called program must return by its own code: a program end in it is a missing return"),
    flag<&ProgramFacts::sameCodeTwiceStops>(
        "sameCodeTwiceStops", "the control also stops at a code that is written twice"),
    flag<&ProgramFacts::fileIsProgram>("fileIsProgram",
                                       "a text without a program number is a program all the same"),
    flag<&ProgramFacts::tapeMarkEnds>("tapeMarkEnds", "a second % also ends a program"),
    flag<&ProgramFacts::modesOutliveEnd>("modesOutliveEnd",
                                         "modes stay active after the end of the program"),
    flag<&ProgramFacts::callsTakeNoWords>("callsTakeNoWords", "a call takes no words of its block"),
    flag<&ProgramFacts::callsBlocks>(
        "callsBlocks", "a local call names a block as a jump does: one that is missing is told as "
                       "a target that is missing"),
    flag<&ProgramFacts::skipKeepsModes>(
        "skipKeepsModes",
        "a block that may be skipped changes no mode, whether or not a later block relies on it"),
    flag<&ProgramFacts::modesOutliveReturn>(
        "modesOutliveReturn", "modes and frames that a subprogram sets stay active in its caller"),
    flag<&ProgramFacts::repeatsNest>("repeatsNest",
                                     "sections that are repeated lie inside each other or apart"),
    flag<&ProgramFacts::endCutsRepeats>(
        "endCutsRepeats", "an end inside a repeated section ends the program before the repeat"),
    flag<&ProgramFacts::modesStatedAtTargets>(
        "modesStatedAtTargets", "a block that several paths reach states the modes that it needs"),
    flag<&ProgramFacts::everyBlockNumbered>("everyBlockNumbered", "every block has a number"),
    field<&ProgramFacts::stepHeads>("stepHeads", texts,
                                    "calls with which a program of steps begins that only the "
                                    "control's own editor knows",
                                    R"(["E_HEAD", "F_HEAD"])"),
    field<&ProgramFacts::dataKinds>("dataKinds", texts,
                                    "what the names of files and of units of an archive end in "
                                    "that hold data and no program",
                                    R"(["INI", "COM"])"),
    flag<&ProgramFacts::remapsInIni>(
        "remapsInIni", "the machine's INI file, near the program, makes codes (`REMAP=`)"),
    field<&ProgramFacts::folders>("folders", texts,
                                  "folders in which the control keeps programs, in the order in "
                                  "which it looks for a called one; an ending of names begins "
                                  "with a point",
                                  R"(["SPF", ".WPD"])"),
    flag<&ProgramFacts::returnRestarts>(
        "returnRestarts", "a return code in a main program starts it again, which may be meant"),
    flag<&ProgramFacts::flowCodesAlone>(
        "flowCodesAlone", "stops, ends, calls and returns share their block with no other M code"),
};

constexpr Field textFields[] = {
    flag<&TextFacts::bareAxesOfLimits>("bareAxesOfLimits",
                                       "axis letters alone may follow the codes of limits"),
    field<&TextFacts::wholeCodes>(
        "wholeCodes", whole(0, 2),
        "codes are whole numbers; 2: codes with decimals are allowed when they exist", "2"),
    flag<&TextFacts::noBlanksInWords>("noBlanksInWords",
                                      "no blank may be between an address and its number"),
    flag<&TextFacts::noNestedComments>(
        "noNestedComments", "the control stops at an opening parenthesis inside a comment"),
    flag<&TextFacts::axesOfMachine>("axesOfMachine",
                                    "axes that the machine profile does not name are unknown"),
    flag<&TextFacts::isoSignsForeign>(
        "isoSignsForeign", "a tape mark alone, `O1000` and `#1=5` are signs of another control"),
    flag<&TextFacts::oneSeparator>("oneSeparator",
                                   "the arguments of an instruction have one kind of separator"),
    flag<&TextFacts::variantNames>("variantNames",
                                   "`G83/R` is a manual's name of a variant, no code"),
    flag<&TextFacts::kindsOfComments>(
        "kindsOfComments", "comments for the operator and for the reader are of different kinds"),
    flag<&TextFacts::bracketsApart>(
        "bracketsApart",
        "a bracket without its partner is told apart from other errors of an expression"),
    flag<&TextFacts::statementsAlone>(
        "statementsAlone", "assignments, jumps and loops share their block with no words"),
    flag<&TextFacts::loopsAlone>("loopsAlone",
                                 "the brackets of loops share their block with no words"),
    flag<&TextFacts::noBareAxes>("noBareAxes",
                                 "axis letters alone do not name the axes of a reference return"),
    flag<&TextFacts::noMinusAtNumbers>("noMinusAtNumbers",
                                       "numbers of tools, offsets and speeds take no sign"),
    flag<&TextFacts::tapeMarkInComments>("tapeMarkInComments",
                                         "a % ends the text inside a comment too"),
    flag<&TextFacts::pointsThroughout>(
        "pointsThroughout",
        "a program means its lengths with a decimal point, or without one, throughout"),
};

constexpr Field variablesFields[] = {
    field<&VariableFacts::greatest>("greatest", wholeNumber,
                                    "greatest number of a variable; 0: not limited", "2049"),
    field<&VariableFacts::lastKept>("lastKept", wholeNumber,
                                    "last one that keeps an earlier program's value; 0: not known",
                                    "2049"),
    field<&VariableFacts::reservedFrom>("reservedFrom", wholeNumber,
                                        "first variable that the control keeps for itself", "1000"),
    field<&VariableFacts::reservedTo>(
        "reservedTo", number, "last one that the control keeps for itself; -1: none", "1049"),
    flag<&VariableFacts::numbered>("numbered", "variables have numbers after `#`"),
    field<&VariableFacts::volatileFrom>(
        "volatileFrom", wholeNumber,
        "variables from this number on do not keep their values; 0: all do", "1050"),
    flag<&VariableFacts::sharedByPrograms>("sharedByPrograms",
                                           "a called program writes the variables of its caller"),
    flag<&VariableFacts::tangentHasPoles>(
        "tangentHasPoles", "the tangent of 90 degrees is an error; left out: it is a large number"),
    field<&VariableFacts::gaps>("gaps", listOf(wholeNumber),
                                "first and last number of each range that has no variables",
                                "[34, 99]"),
    field<&VariableFacts::ofMacros>(
        "ofMacros", listOf(wholeNumber),
        "first and last number of each range that the control's own macros write", "[550, 599]"),
    field<&VariableFacts::shownAhead>(
        "shownAhead", listOf(wholeNumber),
        "first and last number of each range of places that change as the control reads ahead",
        "[5021, 5069]"),
    field<&VariableFacts::workPlaces>(
        "workPlaces", listOf(wholeNumber),
        "first and last number of each range of places in the work's coordinates", "[5041, 5060]"),
    field<&VariableFacts::lacksFunctions>("lacksFunctions", texts,
                                          "functions of its family that the control lacks",
                                          R"(["FUP", "LN"])"),
    field<&VariableFacts::frameParts>(
        "frameParts", texts,
        "names of the parts of a frame, which are the last index of its variable",
        R"(["TR", "RT"])"),
};

} // namespace

constexpr RecordOf<MessageFacts> messageFactRecord =
    RecordOf<MessageFacts>{"facts of messages", "texts that a program shows to the operator",
                           messagesFields}
        .overlay();

constexpr RecordOf<ProgramFacts> programFactRecord =
    RecordOf<ProgramFacts>{"facts of program", "what holds for programs and their ends",
                           programFields}
        .overlay();

constexpr RecordOf<TextFacts> textFactRecord =
    RecordOf<TextFacts>{"facts of text", "what holds for how text is read", textFields}.overlay();

constexpr RecordOf<VariableFacts> variableFactRecord =
    RecordOf<VariableFacts>{"facts of variables", "what holds for numbered variables",
                            variablesFields}
        .overlay();

} // namespace ncvet
