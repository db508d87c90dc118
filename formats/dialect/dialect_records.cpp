// The keys of a dialect's table outside of its codes: one line for each.
#include "formats/dialect/dialect_builder.h"
#include "formats/dialect/field.h"
#include "formats/dialect/records.h"
#include "formats/dialect/vocabulary.h"

#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

using namespace shape;

constexpr llvm::StringLiteral readers[] = {"iso", "sinumerik", "ecs", "mefi"};
Names readerNames() { return readers; }

constexpr Field drillingFields[] = {
    flag<&Dialect::drilling, &DrillingHabits::levelOfRow>(
        "levelOfRow", "the initial level is the one at which a row of cycles began, not the one "
                      "before the single cycle"),
    flag<&Dialect::drilling, &DrillingHabits::risesFirst>(
        "risesFirst", "below the level of approach the tool first rises to it, and it withdraws no "
                      "lower"),
    flag<&Dialect::drilling, &DrillingHabits::feedsOutToLevel>(
        "feedsOutToLevel", "cycles that are fed out are fed to the level to which they withdraw"),
    flag<&Dialect::drilling, &DrillingHabits::pecksExactly>(
        "pecksExactly", "a last peck that only rounding leaves is made too"),
};
constexpr RecordOf<Dialect> drillingRecord{
    "drilling", "how a control drills, where controls differ", drillingFields};

constexpr Field toolRadiusFields[] = {
    field<&Dialect::toolRadius, &ToolRadiusSource::variable>(
        "variable", text,
        "the variable, with {tool}, {edge}, {offset} and {offsetOrTool} for numbers; of several, "
        "divided by `|`, the first that is set counts",
        "\"$TC_DP6[{tool},{edge}]\""),
    field<&Dialect::toolRadius, &ToolRadiusSource::allowance>(
        "allowance", text, "the variable with a stock that is added to the radius", "\"_DRA\""),
};
constexpr RecordOf<Dialect> toolRadiusRecord{
    "toolRadius", "where a program itself sets the radius that compensation uses",
    toolRadiusFields};

constexpr Field zeroFields[] = {
    field<&ZeroVariables::systems>("systems", wholeNumber,
                                   "first variable of the first work "
                                   "offset",
                                   "5221"),
    field<&ZeroVariables::step>("step", wholeNumber, "from one work offset to the next", "20"),
    field<&ZeroVariables::preset>("preset", wholeNumber,
                                  "first variable of the shift over all work offsets", "5211"),
    field<&ZeroVariables::presetOn>("presetOn", wholeNumber,
                                    "variable that is 1 where that shift is in force", "5210"),
    field<&ZeroVariables::length>("length", wholeNumber,
                                  "first variable of the length offset in force", "5401"),
};
constexpr RecordOf<ZeroVariables> zeroRecord{
    "zeros",
    "numbers of the variables in which a control keeps where its coordinates are, in millimetres "
    "and "
    "degrees on the machine: each the first of one for every axis, X first",
    zeroFields};

constexpr Field variableFields[] = {
    field<&Dialect::variableNames>("names", texts,
                                   "variables of the control with names of their "
                                   "own",
                                   R"(["$P_TOOL", "$AA_IW"])"),
    field<&Dialect::axisVariables>("axes", texts, "those of them that hold the name of an axis",
                                   R"(["AXS"])"),
    field<&Dialect::readOnly>("readOnly", texts,
                              "beginnings of names of variables that a program cannot write",
                              R"(["V1025"])"),
    field<&Dialect::readOnlyNumbers>(
        "readOnlyNumbers", listOf(wholeNumber),
        "first and last number of each range of `#` that a program cannot write", "[1000, 1098]"),
    field<&Dialect::machineData>(
        "machineData", texts, "beginnings of names of variables that hold for every later program",
        R"(["$MC_"])"),
    field<&Dialect::readAhead>("readAhead", texts,
                               "beginnings of names of variables that the control reads while it "
                               "prepares, before the moves written earlier are done",
                               R"(["$AA_", "$AC_"])"),
    field<&Dialect::variableRanges, &VariableRanges::lastLocal>(
        "lastLocal", wholeNumber, "`#1` up to this number belong to the running program", "30"),
    field<&Dialect::variableRanges, &VariableRanges::lastCommon>(
        "lastCommon", wholeNumber, "from there up to this number all programs share them", "5602"),
    flag<&Dialect::variableRanges, &VariableRanges::namedLocal>(
        "namedLocal", "a variable with a name belongs to the running program, save `#<_name>`"),
    flag<&Dialect::localsBeginVacant>("localsBeginVacant",
                                      "false: a main program finds the values of the one before it",
                                      "false"),
    field<&Dialect::variableRanges, &VariableRanges::place>(
        "place", wholeNumber, "first of the variables that hold the tool's coordinates, X first",
        "5420"),
    special<&DialectBuilder::readShown>(
        "shown", mapOf(text),
        "variables that hold the `tool` in the spindle, the `feed`, the `speed`, or where an axis "
        "is on the machine (`machine-x`)",
        R"({"5400": "tool", "_feed": "feed"})"),
    field<&Dialect::zeros>("zeros", object(zeroRecord),
                           "the variables in which the control keeps where its coordinates are"),
};
constexpr RecordOf<Dialect> variableRecord{"variables", "the variables of a control",
                                           variableFields};

constexpr Field lexicalFields[] = {
    flag<&Lexical::incrementOperator>("incrementOperator", "`XI-4` is an increment"),
    field<&Lexical::commaAddresses>("commaAddresses", addresses, "which of `,A ,C ,R` exist",
                                    "\",R,C\""),
    field<&Lexical::semicolon>("semicolon", name("meaning of a semicolon", semicolonNames),
                               "what a semicolon means", "\"end-of-block\""),
    flag<&Lexical::percentHeader>("percentHeader", "`%O1234` is a program's first line"),
    flag<&Lexical::macro>("macro", "variables, expressions, IF, WHILE and GOTO are known", "false"),
    flag<&Lexical::structures>(
        "structures", "loops, branches and definitions are known where the reader knows them",
        "false"),
    flag<&Lexical::flowWords>(
        "flowWords", "O-words control the flow: `o100 sub`, `o<name> call [1]`, `o101 if [..]`; "
                     "Macro B's IF, WHILE and GOTO are then unknown"),
    flag<&Lexical::assignsAfterWords>("assignsAfterWords",
                                      "assignments take effect after the words of their block"),
    flag<&Lexical::conditionFirst>(
        "conditionFirst", "a condition in brackets may be before the words that it guards: "
                          "`[#100 LT 10] M99 P10`"),
    flag<&Lexical::fileInComment>(
        "fileInComment", "a comment after a code that calls gives the file that is called: "
                         "`M98 (PART.NC)`"),
    flag<&Lexical::freeNumbers>("freeNumbers",
                                "numbers may contain blanks, and block numbers may have decimals"),
    field<&Lexical::arithmetic>(
        "arithmetic", name("arithmetic", arithmeticNames),
        "how expressions are read: `macro-b-30i` has named variables `[#NAME]`, POW, AX, AXNUM and "
        "PRM besides; in `macro-b-decimal` the number of a variable may have decimals "
        "(`#30003.078`); `ngc` has `**`, logic after comparisons, and operators in brackets only",
        "\"ngc\""),
    flag<&Lexical::blocksSpanLines>("blocksSpanLines",
                                    "a block ends where the next one begins, not with its line"),
    flag<&Lexical::commaSeparates>("commaSeparates", "commas separate arguments"),
    flag<&Lexical::indexedNames>("indexedNames",
                                 "axes and spindles may have names with an index, before an equals "
                                 "sign: `X1=10.`, `S2=500`"),
    flag<&Lexical::namedPrograms>("namedPrograms",
                                  "`<NAME>` heads a program, and calls name it so"),
    flag<&Lexical::tapeLeader>("tapeLeader",
                               "what comes before the first `%` and a program's header is no code"),
    field<&Lexical::headerMarks>("headerMarks", text,
                                 "characters with which a program's first line may begin", "\"%\""),
    field<&Lexical::endLabel>("endLabel", text, "label that ends a repeated section",
                              "\"ENDLABEL\""),
    field<&Lexical::abortMark>(
        "abortMark", text,
        "a comment that begins with it, in either case, stops the program with an alarm",
        "\"abort,\""),
    field<&Lexical::axisSwitches>("axisSwitches", texts,
                                  "names that give an axis a property and no value: `SCC[X]`",
                                  R"(["SCC"])"),
    field<&Lexical::callMark>("callMark", text,
                              "how a call of a program by its name begins; `>` ends it", "\"L<\""),
    field<&Lexical::foreignJump>(
        "foreignJump", text, "word of a jump in the other language that the control understands",
        "\"GOTO\""),
    field<&Lexical::skipLevels>("skipLevels", whole(0, 9),
                                "block skip `/1` to `/9`; 1: plain `/` "
                                "only",
                                "9"),
};

constexpr Shape depth = whole(0, 100);
constexpr Shape reservedNumber = whole(0, 99999999);
constexpr Shape digitCount = whole(0, 20);
constexpr Field limitFields[] = {
    field<&Limits::functionsPerBlock>("functionsPerBlock", depth,
                                      "words M, S, T, D and H in a block together; 0: not limited",
                                      "10"),
    field<&Limits::mCodesPerBlock>("mCodesPerBlock", depth, "M codes in a block; 0: not limited",
                                   "1"),
    field<&Limits::callDepth>("callDepth", depth,
                              "levels of calls below the main program; 0: not documented", "9"),
    field<&Limits::packedCallDigits>(
        "packedCallDigits", digitCount,
        "digits of a program's number in a call whose P has the count of runs before it "
        "(`P51000`); 0: P is the number alone",
        "4"),
    field<&Limits::protectedPrograms>(
        "protectedPrograms", reservedNumber,
        "programs from this number on, of four digits, belong to the machine's builder: they need "
        "not lie in the project; 0: none do",
        "8000"),
    field<&Limits::blockLength>("blockLength", whole(0, 10000),
                                "characters of a block; 0: not limited", "255"),
    field<&Limits::structureDepth>("structureDepth", depth,
                                   "structures in each other; 0: not limited", "16"),
    field<&Limits::repeatDepth>("repeatDepth", depth, "repeats in each other; 0: not limited", "7"),
    field<&Limits::labelLength>("labelLength", depth, "letters of a label that count; 0: all", "8"),
    field<&Limits::nameLength>("nameLength", depth, "letters of a program's name; 0: not limited",
                               "24"),
    special<&DialectBuilder::readProgramDigits>(
        "programDigits", listOf(digitCount, 2, 2),
        "least and greatest number of digits of a program's number; 0: not limited", "[1, 5]"),
    field<&Limits::reservedPrograms>("reservedPrograms", listOf(reservedNumber),
                                     "numbers of programs that belong to the control", "[8999]"),
};
constexpr RecordOf<Limits> limitRecord =
    RecordOf<Limits>{"limits", "how much a control takes", limitFields}.overlay();

constexpr Field addressFields[] = {
    field<&AddressInfo::kind>("kind", name("kind of address", addressKindNames, 1),
                              "what its words are", "\"axis\"")
        .mustBeThere(),
    field<&AddressInfo::unit>("unit", name("unit", addressUnitNames), "unit of its values",
                              "\"length\""),
    field<&AddressInfo::axis>("axis", name("axis", axisNames),
                              "axis of an axis word or an increment", "\"X\""),
    flag<&AddressInfo::diameter>("diameter", "the value is a diameter"),
    flag<&AddressInfo::repeatable>("repeatable", "may occur more than once in a block"),
    flag<&AddressInfo::pointAdvised>("pointAdvised",
                                     "the control may scale a value without a decimal point"),
    field<&AddressInfo::least>("min", number, "least value", "0"),
    field<&AddressInfo::most>("max", number, "greatest value", "32000"),
    flag<&AddressInfo::corner>("corner", "asks for a chamfer or a rounding to the next move"),
    flag<&AddressInfo::rounding>("rounding", "the corner is a rounding"),
    flag<&AddressInfo::linesOnly>("linesOnly", "the corner is between two straight lines only"),
    flag<&AddressInfo::acrossCorner>("acrossCorner",
                                     "a chamfer by its own length, not by that of its legs"),
    flag<&AddressInfo::lineAngle>("lineAngle", "direction of a straight line"),
    flag<&AddressInfo::lineLength>(
        "lineLength", "length of a straight line; without its direction beside it, it is the "
                      "number of an offset on another control"),
    special<&DialectBuilder::readAddressArc>(
        "arc", name("meaning in an arc", arcWordNames),
        "radius or opening angle of an arc, or a coordinate of a point that it leads through",
        "\"angle\""),
    special<&DialectBuilder::readAddressAction>("does", name("action", addressActionNames),
                                                "what the control does with the value",
                                                "\"speed-limit\""),
    special<&DialectBuilder::readAddressSwitch>(
        "switch", text, "switch that a value other than zero turns on", "\"rounding\""),
    field<&AddressInfo::title>("title", text, "what it means, lower case", "\"arc centre\""),
};

constexpr Field groupFields[] = {
    field<&GroupInfo::title>("title", text, "name for messages; the key when left out",
                             "\"radius compensation\""),
    elsewhere("initial", text, "member in force at power-on, only where a manual says so",
              "\"G40\""),
    flag<&GroupInfo::exclusive>("exclusive", "two members in one block are a conflict", "false"),
    flag<&GroupInfo::oneShot>("oneShot", "its codes act in their own block only"),
    flag<&GroupInfo::forgetsFeed>("forgetsFeed",
                                  "a code of it without F in its block leaves no feed in force"),
    special<&DialectBuilder::readActsAs>("actsAs", texts,
                                         "groups with a meaning of their own that this one is too",
                                         R"(["speed-mode"])"),
};

constexpr Field switchFields[] = {
    field<&SwitchInfo::title>("title", text, "name for messages; the key when left out",
                              "\"coolant\""),
    field<&SwitchInfo::off>("off", text, "how to switch it off, for messages", "\"M09\""),
    field<&SwitchInfo::leftOn>("leftOn", text,
                               "rule that reports it when it is on at the program's end",
                               "\"modal-coolant-left-on\""),
    field<&SwitchInfo::severity>("severity", name("severity", severityNames),
                                 "of that report, when it differs from the rule's", "\"style\""),
    flag<&SwitchInfo::atToolChange>("atToolChange", "also reported at a tool change"),
    flag<&SwitchInfo::survivesReset>("survivesReset", "a reset code leaves it as it is"),
    flag<&SwitchInfo::blocksAreData>("blocksAreData",
                                     "what blocks hold while it is on are data; a program that "
                                     "ends leaves it on for no other"),
    field<&SwitchInfo::mostNamed>(
        "mostNamed", whole(0, 999),
        "things of its kind that the control keeps by name, as matrices; 0: any number", "6"),
};

void readToldAt(JsonReader &in, const Json &value, RuleOverride &rule) {
  if (!in.isObject(value))
    return;
  for (auto entry = value.begin(); entry != value.end(); ++entry)
    if (entry->is_string())
      rule.toldAt[entry.key()] = entry->get<std::string>();
    else
      in.fail(*entry, "the name of a rule is expected");
}

constexpr Field ruleFields[] = {
    field<&RuleOverride::severity>("severity", name("severity", severityNames),
                                   "severity of its findings on this control", "\"style\""),
    elsewhere("because", text,
              "why the same finding weighs more or less on this control than its page says; needed "
              "beside `severity`",
              "\"parameter 3403#6 decides between the last word and an alarm\""),
    field<&RuleOverride::enabled>("enabled", boolean,
                                  "whether the rule is on unless a user says "
                                  "otherwise",
                                  "true"),
    field<&RuleOverride::toldAs>(
        "toldAs", text,
        "rule under whose name its findings are told, where this control's manual has one rule for "
        "both",
        "\"block-missing-word\""),
    special<readToldAt>("toldAt", mapOf(text),
                        "by code: rule under whose name its findings in a block that has the code, "
                        "or moves by it, are told, where this control's manual says it of that "
                        "code by another rule",
                        R"({"G51": "cycle-parameter-out-of-range"})"),
    flag<&RuleOverride::uncalledStops>(
        "uncalledStops",
        "the control also stops at what the rule reports in a body that it does not run"),
};

constexpr Field markFields[] = {
    field<&DetectMark::pattern>("pattern", text,
                                "POSIX extended regular expression, matched against single lines",
                                R"("^G28 U0")")
        .mustBeThere(),
    field<&DetectMark::score>("score", whole(-100, 100),
                              "added once when any of the first lines matches", "3"),
    field<&DetectMark::reason>("reason", text, "why it speaks for the control; `--stats` shows it",
                               R"("`G28 U0` moves a lathe home")")
        .mustBeThere(),
};
constexpr RecordOf<DetectMark> markRecord{"mark", "a mark in a program's text", markFields};
constexpr Shape mark = object(markRecord);

constexpr Field detectionFields[] = {
    field<&ProgramMarks::extensions>(
        "extensions", texts, "file name endings that speak for the control, without the dot",
        R"(["mpf"])"),
    field<&ProgramMarks::marks>("marks", listOf(mark), "marks in a program's text"),
};

constexpr Field otherControlFields[] = {
    field<&OtherControlFile::readAs>("readAs", text,
                                     "id of the dialect whose language is nearest; none: the one "
                                     "that the text looks most like",
                                     "\"linuxcnc\""),
    flag<&OtherControlFile::forMachine>("forMachine", "a machine runs such texts"),
    flag<&OtherControlFile::alike>("alike",
                                   "its language is nearly that of the dialect that it is read as"),
    field<&OtherControlFile::highest>("highestSeverity", name("severity", severityNames),
                                      "no finding that tells of such a text is more severe",
                                      "\"style\""),
    field<&OtherControlFile::marks>("marks", listOf(mark), "marks in a program's text"),
};

constexpr Shape anAddress = object(addressRecord), aGroup = object(groupRecord),
                aSwitch = object(switchRecord), aCode = object(codeRecord),
                aRule = object(ruleRecord), anything{Form::Map};

/// True or false, a number, or one of the option's names, which the rule's page lists.
constexpr Shape optionOfRule = scalar;

constexpr Field dialectFields[] = {
    elsewhere("$schema", text, "for editors", "\"../schema/dialect.schema.json\"").ofEachFile(),
    field<&Dialect::id>("id", textLike("^[a-z0-9-]+$"),
                        "as given to `--dialect`; the name of the file", "\"haas-lathe\"")
        .ofEachFile()
        .mustBeThere(),
    field<&Dialect::title>("title", text, "name of the control", "\"Haas lathe, classic control\"")
        .ofEachFile()
        .mustBeThere(),
    elsewhere("extends", text, "the dialect that this one is laid over", "\"iso-turning\"")
        .ofEachFile(),
    flag<&Dialect::abstract>("abstract", "a base for others only: it cannot be chosen")
        .ofEachFile(),
    field<&Dialect::reader>("reader", name("reader", readerNames), "family of grammars", "\"iso\"")
        .mustBeThere(),
    field<&Dialect::machine>("machine", name("machine", machineNames), "kind of machine",
                             "\"lathe\"")
        .mustBeThere(),
    elsewhere("source", text, "the book whose lines the sources of codes name",
              "\"operator's manual, 1986\"")
        .ofEachFile(),
    flag<&Dialect::toolChangeByT>("toolChangeByT",
                                  "the T word itself changes the tool; otherwise a code does"),
    flag<&Dialect::offsetsOfTool>(
        "offsetsOfTool", "length and radius come with the tool itself; a D, if any, chooses "
                         "one of its edges"),
    elsewhere("toolChangeGivesLength", boolean,
              "a tool change puts the tool's length in force, whatever a code has switched off",
              "true"),
    flag<&Dialect::profileRunsThrough>(
        "profileRunsThrough",
        "after a roughing cycle the control runs the profile's blocks itself"),
    flag<&Dialect::dwellInMilliseconds>("dwellInMilliseconds",
                                        "a dwell time without a point counts in 1/1000 s"),
    flag<&Dialect::dwellBesideMove>("dwellBesideMove", "a block that dwells may move too"),
    flag<&Dialect::cycleSurvivesMotion>("cycleSurvivesMotion",
                                        "a motion code does not end a drilling cycle"),
    flag<&Dialect::emptyBlocksRun>("emptyBlocksRun",
                                   "an active cycle runs in blocks without words too"),
    flag<&Dialect::callsKeepModes>(
        "callsKeepModes",
        "programs that are not known leave plane, distances, compensation, cycle and "
        "units as they are: the builder's macros do so by custom"),
    flag<&Dialect::endReturns>("endReturns",
                               "a program end inside a called program leads back to the caller"),
    flag<&Dialect::polarByDistance>(
        "polarByDistance", "under incremental distances, words of angle and radius add up"),
    flag<&Dialect::loadsWhole>("loadsWhole",
                               "blocks that no path reaches are read all the same when the program "
                               "is loaded",
                               "false"),
    within("drilling", drillingRecord, "how the control drills, where controls differ"),
    field<&Dialect::mainExtensions>("mainExtensions", texts, "file name endings of main programs",
                                    R"(["mpf"])"),
    field<&Dialect::subprogramExtensions>("subprogramExtensions", texts,
                                          "file name endings of subprograms", R"(["spf", "cyc"])"),
    field<&Dialect::hiddenPrograms>("hiddenPrograms", texts,
                                    "beginnings of the names of the control's own programs: a "
                                    "program of the project with such a "
                                    "name is called in their place",
                                    R"(["CYCLE", "POCKET"])"),
    within("variables", variableRecord, "the variables of the control"),
    special<&DialectBuilder::readOptions>(
        "options", mapOf(scalar),
        "options of the machine profile with their defaults; null: not known",
        R"({"liveTools": null})"),
    elsewhere(
        "controls", mapOf(anything),
        "single controls of the family, by the value of the option `control`: what differs is "
        "laid over the table",
        R"({"802D": {"limits": {"callDepth": 7}}})"),
    elsewhere("byOption", mapOf(anything),
              "what an option of the machine profile changes, by the option and its value: it is "
              "laid over the table",
              R"({"toolChangeByM6": {"false": {"toolChangeByT": true}}})"),
    special<&DialectBuilder::readLexical>("lexical", object(lexicalRecord),
                                          "how programs are spelt"),
    field<&Dialect::limits>("limits", object(limitRecord), "how much the control takes"),
    // Addresses and the tool's radius name switches, codes name all of these.
    special<&DialectBuilder::readSwitches>(
        "switches", mapOf(aSwitch),
        "what stays on until it is switched off, by ids of the table's own"),
    within("toolRadius", toolRadiusRecord,
           "where a program itself sets the radius that compensation uses"),
    special<&DialectBuilder::readAddresses>(
        "addresses", mapOf(anAddress, "^(,[ACR]|[A-Z][A-Za-z0-9]*|[@^$]n)$"),
        "the words of the control by their addresses: a letter, `,A ,C ,R`, letters and digits, or "
        "a "
        "character that is no letter with an `n` after it (`$n`)"),
    special<&DialectBuilder::readGroups>("groups", mapOf(aGroup),
                                         "modal groups, of whose codes one is in force"),
    elsewhere("sharedNotices", mapOf(noticesShape),
              "notices that several codes have, by a name that their lists give"),
    special<&DialectBuilder::readCodes>("codes", mapOf(aCode),
                                        "the codes by their names, with at least two digits: "
                                        "`G01`, `M03`, `G84.2`; a code that is a "
                                        "word of its own by that word"),
    field<&Dialect::builderMacros>("builderMacros", text,
                                   "a G code: those from its number on that the table does not "
                                   "have call macros of the machine's builder, as this code does",
                                   "\"G100\""),
    special<&DialectBuilder::readFacts>("facts", object(factRecord),
                                        "what the control does where controls differ, for rules"),
    special<&DialectBuilder::readRules>("rules", mapOf(aRule),
                                        "what holds for a rule on this control, by its id"),
    special<&DialectBuilder::readDetect>("detect", object(detectionRecord),
                                         "how programs for this control are told; not inherited")
        .ofEachFile(),
};

} // namespace

constexpr RecordOf<Lexical> lexicalRecord =
    RecordOf<Lexical>{"lexical", "how programs are spelt", lexicalFields}.overlay();
constexpr RecordOf<AddressInfo> addressRecord =
    RecordOf<AddressInfo>{"address", "what words with one address are", addressFields}.overlay();
constexpr RecordOf<GroupInfo> groupRecord =
    RecordOf<GroupInfo>{"group", "codes of which one at a time is in force", groupFields}.overlay();
constexpr RecordOf<SwitchInfo> switchRecord =
    RecordOf<SwitchInfo>{"switch", "something that stays on until it is switched off", switchFields}
        .overlay();
constexpr RecordOf<RuleOverride> ruleRecord =
    RecordOf<RuleOverride>{"rule",
                           "what holds for a rule on this control; further keys are options "
                           "of the rule",
                           ruleFields}
        .overlay()
        .with(optionOfRule);
constexpr RecordOf<ProgramMarks> detectionRecord{"detect", "how programs for a control are told",
                                                 detectionFields};
constexpr RecordOf<OtherControlFile> otherControlRecord{
    "other control", "how programs for a control without a table are told", otherControlFields};
constexpr RecordOf<Dialect> dialectRecord =
    RecordOf<Dialect>{"dialect", "a control's language as a table", dialectFields}.overlay();

} // namespace ncvet
