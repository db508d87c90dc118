// The keys of configurations, of profiles of rules and of the table of detection.
#include "formats/dialect/config_file.h"
#include "formats/dialect/dialect_builder.h"
#include "formats/dialect/field.h"
#include "formats/dialect/vocabulary.h"

#include <nlohmann/json.hpp>

#include <array>
#include <utility>

namespace ncvet {

namespace {

using namespace shape;

constexpr llvm::StringLiteral failOnLevels[] = {"error", "warning", "style", "never"};

constexpr Shape aSeverity = name("severity", severityNames), aValue = scalar,
                optionsOfRule = mapOf(aValue), aMachine = object(machineRecord);

template <typename First, size_t B, size_t... I, size_t... J>
constexpr std::array<Field, sizeof...(I) + B> joined(const First &a, const std::array<Field, B> &b,
                                                     std::index_sequence<I...>,
                                                     std::index_sequence<J...>) {
  return {a[I]..., b[J]...};
}
template <size_t A, size_t B>
constexpr std::array<Field, A + B> joined(const Field (&a)[A], const std::array<Field, B> &b) {
  return joined(a, b, std::make_index_sequence<A>(), std::make_index_sequence<B>());
}
template <size_t A, size_t B>
constexpr std::array<Field, A + B> joined(const std::array<Field, A> &a,
                                          const std::array<Field, B> &b) {
  return joined(a, b, std::make_index_sequence<A>(), std::make_index_sequence<B>());
}

/// The keys that configurations and profiles share; `Rules` is the member that they go into.
template <auto Rules>
constexpr std::array<Field, 5> choiceFields() {
  return {
      field<Rules, &RuleChoices::select>("select", texts,
                                         "only these rules: ids, categories, or `all`",
                                         R"(["feed", "tool-missing"])"),
      field<Rules, &RuleChoices::extendSelect>("extendSelect", texts, "these rules as well",
                                               R"(["style"])"),
      field<Rules, &RuleChoices::ignore>("ignore", texts, "not these rules",
                                         R"(["program-block-number-missing"])"),
      elsewhere("severity", mapOf(aSeverity), "severity by rule or category",
                R"({"feed-implausible": "error"})"),
      elsewhere("options", mapOf(optionsOfRule),
                "options by rule; `ncvet explain RULE` describes them",
                R"({"feed-implausible": {"perMinuteBelow": 2}})"),
  };
}

/// The keys that configurations and their overrides share; `Owner` is the struct that they go into.
template <typename Owner>
constexpr std::array<Field, 4> fileFields() {
  return {
      field<&Owner::dialect>("dialect", text, "id of the control, the path of a table, or `auto`",
                             "\"haas-mill\""),
      elsewhere("machine", either(text, aMachine),
                "profile of the machine: a path, or the profile itself", "\"machines/vf2.json\""),
      field<&Owner::failOn>("failOn", name("level", failOnNames),
                            "the least severity that makes the exit code 1", "\"warning\""),
      field<&Owner::searchFolders>("searchFolders", texts,
                                   "folders in which programs that are called are looked for, "
                                   "after the caller's own",
                                   R"(["../subprograms"])"),
  };
}

constexpr Field ownOverrideFields[] = {
    field<&OverrideFile::files>("files", texts,
                                "globs of the files that the other keys are for, as those of "
                                "`exclude`",
                                R"(["lathe/", "*.min"])")
        .mustBeThere(),
};
constexpr auto overrideFields = joined(joined(ownOverrideFields, fileFields<OverrideFile>()),
                                       choiceFields<&OverrideFile::rules>());
constexpr Shape anOverride = object(overrideRecord);

constexpr Field ownConfigFields[] = {
    elsewhere("$schema", text, "for editors", "\"rulesets/schema/config.schema.json\""),
    field<&ConfigFile::extends>(
        "extends", text,
        "a profile (`recommended`, `strict`, `all`), or the path of another "
        "configuration that this one is laid over",
        "\"strict\""),
    field<&ConfigFile::dialects>("dialects", texts,
                                 "tables of one's own, which then can be chosen and are found out "
                                 "like the built-in ones",
                                 R"(["tables/our-lathe.json"])"),
    field<&ConfigFile::files>("files", texts,
                              "globs of further part programs in folders: without `/` a glob "
                              "matches the name, else the path below this file's folder; `*` "
                              "matches any text",
                              R"(["O[0-9]*"])"),
    field<&ConfigFile::exclude>(
        "exclude", texts, "globs of what is left out when folders are checked", R"(["old/"])"),
    elsewhere("overrides", listOf(anOverride),
              "other settings for some of the files; a later one goes before an earlier one",
              R"([{"files": ["lathe/"], "dialect": "haas-lathe"}])"),
};
constexpr auto configFields =
    joined(joined(ownConfigFields, fileFields<ConfigFile>()), choiceFields<&ConfigFile::rules>());

constexpr Field ownProfileFields[] = {
    elsewhere("$schema", text, "for editors", "\"../schema/profile.schema.json\""),
    field<&ProfileFile::title>("title", text, "what the profile is for", "\"All advice\"")
        .mustBeThere(),
    field<&ProfileFile::extends>("extends", text,
                                 "the profile that this one is laid over; none: each rule's own "
                                 "default, as the control's table changes it",
                                 "\"recommended\""),
};
constexpr auto profileFields = joined(ownProfileFields, choiceFields<&ProfileFile::rules>());

constexpr Field unsureFields[] = {
    field<&UnsureFile::ignore>("ignore", texts,
                               "rules and categories that need facts of the control; a user's "
                               "selection goes before",
                               R"(["tool"])"),
    field<&UnsureFile::highest>("highestSeverity", aSeverity, "no finding is more severe",
                                "\"warning\""),
    field<&UnsureFile::toldOfOthers>("toldOfOthers", texts,
                                     "categories of what is told of a text for a control without "
                                     "a table",
                                     R"(["syntax"])"),
    field<&UnsureFile::differsInAlike>("differsInAlike", texts,
                                       "categories in which also controls differ whose language "
                                       "is nearly the same",
                                       R"(["flow"])"),
};
constexpr RecordOf<UnsureFile> unsureRecord{
    "unsure", "what is reported when the control is a guess", unsureFields};

constexpr Shape marksOfControl = object(otherControlRecord);

void readOtherControls(JsonReader &in, const Json &value, DetectFile &file) {
  if (!in.isObject(value))
    return;
  for (auto entry = value.begin(); entry != value.end(); ++entry)
    readInto(in, *entry, otherControlRecord, file.otherControls[entry.key()]);
}

constexpr Shape score = whole(0, 100);

constexpr Field detectFields[] = {
    elsewhere("$schema", text, "for editors", "\"schema/detect.schema.json\""),
    field<&DetectFile::fallback>("fallback", text, "id of the dialect when nothing speaks for any",
                                 "\"fanuc-0m\"")
        .mustBeThere(),
    field<&DetectFile::prefer>("prefer", texts,
                               "ids of dialects; of equal scores the one that is first wins",
                               R"(["fanuc-0m", "haas-mill"])"),
    field<&DetectFile::minimumScore>("minimumScore", score, "less than this is no evidence", "2"),
    field<&DetectFile::sureScore>("sureScore", score, "less than this is a guess", "5"),
    field<&DetectFile::habits>("habits", texts,
                               "patterns of marks that programs for several controls have",
                               R"(["G43.*H[0-9]"])"),
    field<&DetectFile::mostByHabits>("mostByHabits", score,
                                     "all marks of habits together, and an ending that several "
                                     "controls have, count no more than this",
                                     "4"),
    field<&DetectFile::unsure>("unsure", object(unsureRecord),
                               "what is reported when the control is a guess"),
    special<readOtherControls>("otherControls", mapOf(marksOfControl),
                               "marks of controls without a table, by the control's name: a "
                               "program that has them is read as the nearest dialect, as a guess"),
    field<&DetectFile::extensions>("extensions", texts,
                                   "endings of file names that part programs have, in lower case, "
                                   "without the dot; those of the tables are added",
                                   R"(["nc", "tap"])"),
    field<&DetectFile::looseExtensions>("looseExtensions", texts,
                                        "endings of many things: the text decides; an empty one: "
                                        "no ending",
                                        R"(["txt", ""])"),
};

} // namespace

llvm::ArrayRef<llvm::StringLiteral> failOnNames() { return failOnLevels; }

constexpr RecordOf<ConfigFile> configRecord{"config",
                                            "configuration of ncvet: .ncvet.json; the nearest file "
                                            "in the program's folder or above counts, "
                                            "and paths are relative to the file's own folder",
                                            configFields};
constexpr RecordOf<OverrideFile> overrideRecord{
    "override", "settings for some of the files of a configuration", overrideFields};
constexpr RecordOf<ProfileFile> profileRecord{"profile", "a selection of rules", profileFields};
constexpr RecordOf<DetectFile> detectRecord{
    "detect table", "how ncvet finds out the control of a program", detectFields};

} // namespace ncvet
