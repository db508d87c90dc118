// The keys of a code's entry, its words, conditions and notices: one line for each.
#include "formats/dialect/dialect_builder.h"
#include "formats/dialect/field.h"
#include "formats/dialect/measure.h"
#include "formats/dialect/records.h"
#include "formats/dialect/vocabulary.h"

namespace ncvet {

namespace {

using namespace shape;

constexpr Shape severityShape = name("severity", severityNames),
                pointShape = name("point rule", pointNames), cycleShape = name("cycle", cycleNames),
                aNumber = number, aFormula = formula, aText = text, anAddressSet = addresses;

/// The bounds of a value, in a struct that has a `ValueTest` at the end of the path.
template <auto... Path>
constexpr std::array<Field, 7> boundFields() {
  return {field<Path..., &ValueTest::min>("min", number, "least value", "0"),
          field<Path..., &ValueTest::max>("max", number, "greatest value", "9999"),
          flag<Path..., &ValueTest::minExclusive>("minExclusive",
                                                  "the least value itself is not allowed"),
          flag<Path..., &ValueTest::maxExclusive>("maxExclusive",
                                                  "the greatest value itself is not allowed"),
          flag<Path..., &ValueTest::integer>("integer", "the value is a whole number"),
          field<Path..., &ValueTest::oneOf>("oneOf", listOf(aNumber, 1), "the only values allowed",
                                            "[0, 1]"),
          field<Path..., &ValueTest::point>(
              "point", pointShape, "whether the number has a decimal point", "\"required\"")};
}

template <size_t M, size_t N>
constexpr std::array<Field, M + N> join(const std::array<Field, M> &first,
                                        const std::array<Field, N> &second) {
  return [&]<size_t... I, size_t... J>(std::index_sequence<I...>, std::index_sequence<J...>) {
    return std::array<Field, M + N>{first[I]..., second[J]...};
  }
  (std::make_index_sequence<M>(), std::make_index_sequence<N>());
}

constexpr auto testFields =
    join(std::array<Field, 1>{special<&DialectBuilder::readTestWord>(
                                  "word", text, "the word that is tested, by its address", "\"P\"")
                                  .mustBeThere()},
         boundFields());
void checkTest(JsonReader &in, const Json &value, ValueTest &test) { checkBounds(in, value, test); }
constexpr RecordOf<ValueTest> testRecord =
    RecordOf<ValueTest>{"test",
                        "true when the word is in the block and its known value breaks the bounds",
                        testFields}
        .checkedBy<checkTest>();
constexpr Shape test = object(testRecord);

constexpr Field conditionFields[] = {
    field<&Condition::has>("has", addresses, "all of these words are in the block", "\"Q\""),
    field<&Condition::any>("any", addresses, "at least one of these words is in the block",
                           "\"PQ\""),
    field<&Condition::lacks>("lacks", addresses, "none of these words is in the block", "\"XZUW\""),
    field<&Condition::before>("before", addresses, "one of these words is before the code",
                              "\"F\""),
    field<&Condition::after>("after", addresses, "one of these words is after the code", "\"F\""),
    field<&Condition::next>("next", addresses, "the word right after the code is one of these",
                            "\"X\""),
    field<&Condition::noneAfter>("noneAfter", addresses, "none of these words is after the code",
                                 "\"XYZ\""),
    special<&DialectBuilder::readActive>(
        "active", texts, "one of these codes of one group is in force before the block",
        R"(["G91"])"),
    special<&DialectBuilder::readWith>("with", texts, "the block has one of these codes",
                                       R"(["M07", "M08"])"),
    special<&DialectBuilder::readWithout>("without", texts, "the block has none of these codes",
                                          R"(["G90"])"),
    flag<&Condition::first>("first", "the code was not in force before the block"),
    field<&Condition::pending>("pending", cycleShape,
                               "the block before was the parameter block of a two-block cycle of "
                               "this kind",
                               "\"pattern-repeat\""),
    special<&DialectBuilder::readWhenOptions>(
        "options", mapOf(scalar),
        "options of the machine profile have these values; a list means one of",
        R"({"liveTools": false})"),
    field<&Condition::broken>("broken", listOf(test), "each of these tests of words is broken",
                              R"([{"word": "P", "min": 1, "max": 4}])"),
    special<&DialectBuilder::readWhenOn>("on", texts, "switches that are on before the block",
                                         R"(["profile"])"),
    special<&DialectBuilder::readWhenOff>("off", texts, "switches that are off before the block",
                                          R"(["rotation"])"),
    field<&Condition::spindleTurns>("spindleTurns", boolean,
                                    "the spindle certainly turns, or does not, before the block",
                                    "true"),
    field<&Condition::toolKind>("toolKind", texts, "the tool in use is known to be one of these",
                                R"(["facemill"])"),
    field<&Condition::otherToolKind>("otherToolKind", texts,
                                     "the tool in use is known, and none of these", R"(["probe"])"),
    field<&Condition::formula>("formula", formula,
                               "holds between the words of the code; only when all that decides it "
                               "is known",
                               "\"given(DP) and RFP - DPR != DP\""),
};
constexpr Shape conditionShape = object(conditionRecord);

constexpr Field noticeFields[] = {
    field<&Notice::rule>("rule", textLike("^[a-z0-9-]+$"), "id of the rule that reports it",
                         "\"cycle-missing-parameter\"")
        .mustBeThere(),
    field<&Notice::severity>("severity", severityShape, "when it differs from the rule's",
                             "\"warning\""),
    field<&Notice::when>("when", conditionShape, "when it is reported; left out: always"),
    field<&Notice::message>(
        "message", text,
        "what is reported; `{code}` and `{P}` are replaced by the block's own spelling",
        "\"`{code}` limits only the main axes X, Y and Z\"")
        .mustBeThere(),
    special<&DialectBuilder::readNoticePlace>(
        "at", text, "the word to mark: an address, or a variable as `@R30`", "\"P\""),
    flag<&Notice::advice>(
        "advice", "given only where the user selected the rule by its name, its category or "
                  "`all`"),
};
constexpr Shape noticeShape = object(noticeRecord), noticeOrName = either(noticeShape, aText);

constexpr auto wordFields = join(
    std::array<Field, 11>{
        field<&WordSpec::need>("need", name("need", needNames),
                               "whether the word must be there; `first`: in the block that "
                               "makes the code active; `here`: in the block, whatever value "
                               "the variable has from an earlier one",
                               "\"required\""),
        field<&WordSpec::role>("role", name("role", roleNames), "what the word is for",
                               "\"depth\""),
        field<&WordSpec::severity>("severity", severityShape, "severity of its absence",
                                   "\"warning\""),
        elsewhere("when", conditionShape, "the requirement holds only then",
                  R"({"active": ["G17"]})"),
        field<&WordSpec::text>("text", boolean, "the argument is a string", "true"),
        field<&WordSpec::characters>("characters", text,
                                     "what a string may be made of, with ranges", "\"A-Z0-9\""),
        field<&WordSpec::naming>("naming", name("naming", namingNames),
                                 "the word names something of the control that the code "
                                 "defines, uses or drops",
                                 "\"define\""),
        field<&WordSpec::absent>("absent", number,
                                 "the value that counts when the word is not given", "0"),
        field<&WordSpec::rangeSeverity>("rangeSeverity", severityShape,
                                        "severity of a value out of range", "\"warning\""),
        field<&WordSpec::pointAdvised>("pointAdvised", boolean,
                                       "should be written with a decimal point here; over the "
                                       "address's own",
                                       "true"),
        field<&WordSpec::note>("note", text,
                               "what the word means, for messages and hover; two cycles that "
                               "give a variable one note mean the same by it",
                               "\"peck depth\"")},
    boundFields<&WordSpec::range>());
void checkWord(JsonReader &in, const Json &value, WordSpec &word) {
  for (const char *key : {"min", "max", "integer", "oneOf", "point"})
    word.hasRange |= in.member(value, key) != nullptr;
  checkBounds(in, value, word.range);
}

constexpr Field storeFields[] = {
    field<&Store::value>("value", formula, "the value; left out: one that is not known", "\"R\""),
    field<&Store::when>("when", formula, "stored only when it holds", "\"Y > 0\""),
    field<&Store::index>("index", formula, "the key names a list, and this the one of it", "\"P\""),
};

constexpr llvm::StringLiteral states[] = {"off", "on"};
Names stateNames() { return states; }
constexpr Field switchEffectFields[] = {
    special<&DialectBuilder::readSwitchId>("id", text, "the switch", "\"coolant\"").mustBeThere(),
    field<&SwitchEffect::on>("to", name("state", stateNames), "where the code leaves it", "\"on\""),
    flag<&SwitchEffect::offByZero>(
        "offByZero", "a zero value of every axis that the block names switches it off"),
};

constexpr Field levelFields[] = {
    field<&CodeInfo::approach>("approach", formula, "level from which the tool is fed",
                               "\"RFP + SDIS\""),
    field<&CodeInfo::bottom>("bottom", formula, "level to which it is fed", "\"DP\""),
};
constexpr RecordOf<CodeInfo> levelRecord{"levels",
                                         "levels of a cycle along the tool axis, where no word "
                                         "with the role `retract` or `depth` is one",
                                         levelFields};

template <size_t Which>
void readPlace(JsonReader &in, const Json &value, CodeInfo &info) {
  readValue(in, formula, value, info.places[Which]);
}
constexpr Field placeFields[] = {
    field<&CodeInfo::count>("count", formula, "how many places; of a pattern", "\"NUM\""),
    special<readPlace<0>>("first", formula,
                          "first coordinate in the plane, by `index()` from 0; of a thread chain Z",
                          "\"CPA + RAD * cos(STA1 + index() * INDA)\"")
        .mustBeThere(),
    special<readPlace<1>>("second", formula, "second coordinate; of a thread chain the diameter",
                          "\"CPO + RAD * sin(STA1 + index() * INDA)\"")
        .mustBeThere(),
};
constexpr RecordOf<CodeInfo> placeRecord{
    "places", "the places of a pattern; of a motion code where it leads in the plane", placeFields};

template <FrameStep::Kind Kind>
void readStep(JsonReader &in, const Json &value, FrameStep &step) {
  step.kind = Kind;
  step.numbers.clear();
  const std::vector<const Json *> numbers = readList(in, listOf(aFormula), value);
  constexpr size_t exact = Kind == FrameStep::Kind::Turn     ? 1
                           : Kind == FrameStep::Kind::Matrix ? 12
                                                             : 3;
  constexpr size_t withCentre = Kind == FrameStep::Kind::Turn ? 4 : exact;
  if (numbers.size() != exact && numbers.size() != withCentre)
    return in.fail(value, "a shift and a scale have 3 numbers, a turn 1 or 4, a matrix 12");
  for (const Json *number : numbers)
    readValue(in, formula, *number, step.numbers.emplace_back());
}
constexpr llvm::StringLiteral threeAxes[] = {"X", "Y", "Z"};
Names threeAxisNames() { return threeAxes; }
constexpr Field stepFields[] = {
    special<readStep<FrameStep::Kind::Shift>>("shift", listOf(aFormula, 3, 3), "three lengths",
                                              R"(["X", "Y", "0"])"),
    special<readStep<FrameStep::Kind::Turn>>(
        "turn", listOf(aFormula, 1, 4),
        "an angle in degrees, or an angle and three coordinates of its centre", R"(["RC"])"),
    special<readStep<FrameStep::Kind::Scale>>("scale", listOf(aFormula, 3, 3), "three factors",
                                              R"(["SCA", "SCA", "SCA"])"),
    special<readStep<FrameStep::Kind::Matrix>>("matrix", listOf(aFormula, 12, 12),
                                               "three rows, each of three factors and a length"),
    field<&FrameStep::axis>("axis", name("axis", threeAxisNames),
                            "axis of a turn; left out: the tool axis", "\"Z\""),
};
void checkStep(JsonReader &in, const Json &value, FrameStep &step) {
  if (step.numbers.empty())
    in.fail(value, "a step is a shift, a turn, a scale or a matrix, with its numbers");
}
constexpr RecordOf<FrameStep> stepRecord =
    RecordOf<FrameStep>{"step", "one step of a frame", stepFields}.checkedBy<checkStep>();
constexpr Shape step = object(stepRecord);
constexpr Field stepsFields[] = {
    field<&CodeInfo::frameWhen>("when", formula, "the steps are right only when it holds",
                                "\"$_MTX == 1\""),
    field<&CodeInfo::frameSteps>("of", listOf(step), "the steps, the outermost first",
                                 R"([{"shift": ["X", "Y", "0"]}])")
        .mustBeThere(),
};
void markSteps(JsonReader &, const Json &, CodeInfo &info) { info.frame = FrameKind::Steps; }
constexpr RecordOf<CodeInfo> stepsRecord =
    RecordOf<CodeInfo>{"steps", "a frame of shifts, turns, factors and matrices", stepsFields}
        .checkedBy<markSteps>();

constexpr Shape word = object(wordRecord), variantShape = object(variantRecord),
                storeObject = object(storeRecord), store = either(scalar, storeObject),
                needShape = name("need", codeNeedNames), pair = listOf(anAddressSet, 2, 2),
                traitShape = name("trait of a cycle", cycleTraitNames);

constexpr Field codeFields[] = {
    field<&CodeInfo::title>("title", text, "what the code is, lower case", "\"linear feed\""),
    elsewhere("group", text, "modal group; left out: the code acts in its block only",
              "\"motion\""),
    field<&CodeInfo::action>("does", name("action", actionNames), "what the control does",
                             "\"linear\""),
    field<&CodeInfo::cycle>("cycle", cycleShape, "kind of cycle, by its motions", "\"peck\""),
    field<&CodeInfo::firstAxis>("firstAxis", name("axis", threeAxisNames),
                                "axis from which the angles of a plane count, where it is not X of "
                                "XY, Z of ZX or Y of YZ",
                                "\"X\""),
    field<&CodeInfo::frame>("frame", name("frame", frameNames),
                            "how a frame changes coordinates; left out: positions after it are not "
                            "known",
                            "\"mirror-axes\""),
    field<&CodeInfo::spindle>("spindle", name("spindle need", spindleNames),
                              "what the cycle or motion needs of the spindle", "\"running\""),
    special<&DialectBuilder::readNeeds>("needs", listOf(needShape), "what must be in force",
                                        R"(["feed"])"),
    field<&CodeInfo::takes>("takes", addresses,
                            "words that the code reads, besides those in `words`", "\"XZUWF\""),
    special<&DialectBuilder::readFires>("fires", addresses,
                                        "a modal cycle runs again in a later block with one of "
                                        "these; `*`: in every block without a "
                                        "motion code; `plane`: with every move in the plane",
                                        "\"XZUW\""),
    special<&DialectBuilder::readOpposite>("opposite", text, "the code that ends or reverses it",
                                           "\"G80\""),
    special<&DialectBuilder::readSwitch>("switch", object(switchEffectRecord),
                                         "the switch that the code leaves on or off",
                                         R"({"id": "coolant", "to": "on"})"),
    flag<&CodeInfo::cancelsCycle>("cancelsCycle",
                                  "ends an active canned cycle, as `cycle-cancel` does"),
    flag<&CodeInfo::cancelsCalls>("cancelsCalls", "ends a modal call of a program too"),
    flag<&CodeInfo::alone>("alone", "needs a block of its own"),
    flag<&CodeInfo::exclusive>("exclusive", "an action code, of which a block takes one"),
    flag<&CodeInfo::twoBlock>(
        "twoBlock",
        "a parameter block comes before the executing block: it is the block that lacks all words "
        "of "
        "the roles `profile-first`, `target` and `depth`, and a variant says what its words mean"),
    flag<&CodeInfo::waits>("waits", "a modal cycle that does not run in its own block"),
    flag<&CodeInfo::returns>("returns", "the tool comes back to where the move began"),
    flag<&CodeInfo::ownMove>(
        "ownMove",
        "the block's move is the code's own, whatever motion is in force; with an action "
        "of its own it is so between arcs only"),
    flag<&CodeInfo::stopsSpindle>(
        "stopsSpindle", "the spindle does not turn after the code, unless its block starts "
                        "it"),
    flag<&CodeInfo::arrivesSoftly>("arrivesSoftly",
                                   "compensation that leads in along an arc of its own"),
    flag<&CodeInfo::leavesNoSpeed>("leavesNoSpeed",
                                   "its S is its own: after its move no speed is in force"),
    flag<&CodeInfo::endsMotion>("endsMotion", "no motion code is in force after it"),
    flag<&CodeInfo::firesByMotionCode>(
        "firesByMotionCode",
        "what runs after moves runs after a motion code without coordinates too"),
    flag<&CodeInfo::foreign>("foreign", "another control's code, none of this one"),
    flag<&CodeInfo::stopsPreparation>("stopsPreparation",
                                      "the control prepares the next block once all moves written "
                                      "earlier are done"),
    flag<&CodeInfo::elsewhere>("elsewhere",
                               "the program that it calls is on the control or on another device: "
                               "it is not looked for"),
    field<&CodeInfo::family>("family", text,
                             "of cycles: those that one code cancels; `wait-mark`: sets a mark for "
                             "other channels; of feed modes: those in which F has one unit, so "
                             "that a change between them leaves F what it was",
                             "\"canned\""),
    field<&CodeInfo::arguments>("arguments", whole(0, 100),
                                "most arguments that its call takes; 0: not limited", "11"),
    field<&CodeInfo::storedAt>("storedAt", wholeNumber,
                               "first variable of the place to which it leads or that it stores",
                               "5161"),
    special<&DialectBuilder::readWords>(
        "words", mapOf(word),
        "its words by address; alternatives as `X|U`, the third argument of a call as `3 SDIS`, a "
        "variable as `@ENT`",
        R"({"Z|W": {"need": "first", "role": "depth"}})"),
    special<&DialectBuilder::readExcludes>("excludes", listOf(pair),
                                           "pairs of sets of words that exclude each other",
                                           R"([["Q", "IJK"]])"),
    special<&DialectBuilder::readNotices>(
        "notices", listOf(noticeOrName),
        "facts that a rule reports as they are, or names of lists in `sharedNotices`"),
    special<&DialectBuilder::readStores>(
        "stores", mapOf(store),
        "variables that the code leaves for the formulas of later codes: a formula, stored when "
        "the "
        "words that it names are there; true: a value that is not known; false: none any more",
        R"({"_LOW": "X", "_OLD": false})"),
    special<&DialectBuilder::readShows>(
        "shows", mapOf(number),
        "variables of the control that have these values while the code is in force",
        R"({"_metric": 1, "_imperial": 0})"),
    within("levels", levelRecord, "levels of a cycle along the tool axis"),
    within("places", placeRecord, "the places of a pattern, or where a motion code leads"),
    special<&DialectBuilder::readMeasures>("measures", mapByName(aFormula, "measure", measureNames),
                                           "what the motions of a cycle need to know beyond the "
                                           "roles of its words, as formulas of them; "
                                           "lengths in the program's unit",
                                           R"~({"run-out": "floor(P / 100)"})~"),
    special<&DialectBuilder::readTraits>("traits", listOf(traitShape),
                                         "what the motions of a cycle do their own way",
                                         R"(["follows-contour"])"),
    field<&CodeInfo::losesPlace>("losesPlace", formula,
                                 "when it holds, no position is known after the code", "\"1\""),
    within("steps", stepsRecord, "a frame made of steps"),
    elsewhere(
        "variants", listOf(variantShape),
        "what the code is under a condition: the first whose `when` holds replaces the entry"),
    field<&CodeInfo::source>("source", text,
                             "where it is stated; `L560-590` are lines of the table's own source",
                             "\"L560-590\""),
};

constexpr Field variantFields[] = {
    elsewhere("when", conditionShape, "when the code is this variant", R"({"any": "IJ"})")
        .ofEachFile()
        .mustBeThere(),
};

} // namespace

constexpr Shape noticesShape = listOf(noticeShape);
constexpr RecordOf<Condition> conditionRecord =
    RecordOf<Condition>{"condition", "every part that is given must hold", conditionFields}
        .overlay();
constexpr RecordOf<Notice> noticeRecord{"notice", "a fact that a rule reports as it is",
                                        noticeFields};
constexpr RecordOf<WordSpec> wordRecord =
    RecordOf<WordSpec>{"word", "a word of a code's format", wordFields}
        .overlay()
        .checkedBy<checkWord>();
constexpr RecordOf<Store> storeRecord{"store", "a value that a code leaves in a variable",
                                      storeFields};
constexpr RecordOf<SwitchEffect> switchEffectRecord =
    RecordOf<SwitchEffect>{"switchEffect", "where a code leaves a switch", switchEffectFields}
        .overlay();
constexpr RecordOf<CodeInfo> codeRecord =
    RecordOf<CodeInfo>{"code", "a code of the control", codeFields}.overlay();
constexpr RecordOf<Variant> variantRecord =
    RecordOf<Variant>{"variant", "a code's own entry with these keys laid over it", variantFields}
        .overlay()
        .basedOn(codeRecord);

} // namespace ncvet
