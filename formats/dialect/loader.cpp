// Follows `extends`, merges the tables from base to top and builds the dialect.
#include "formats/dialect/loader.h"

#include "formats/dialect/code_name.h"
#include "formats/dialect/dialect_builder.h"

#include "llvm/ADT/StringExtras.h"
#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

constexpr size_t maxExtends = 16; ///< longer chains are loops or mistakes

struct Layers {
  std::vector<JsonLayer> files; ///< base first
  std::vector<Json> values;
};

/// Sources that give lines ("L560-590") become sources that name the book as well, since the merged
/// table has many; and options keep their null, which elsewhere takes an entry away.
void prepareLayer(Json &layer) {
  if (!layer.is_object())
    return;
  auto book = layer.find("source");
  auto codes = layer.find("codes");
  if (codes != layer.end() && codes->is_object() && book != layer.end() && book->is_string())
    for (Json &code : *codes) {
      auto source = code.is_object() ? code.find("source") : code.end();
      if (code.is_object() && source != code.end() && source->is_string() &&
          llvm::StringRef(source->get_ref<const std::string &>()).startswith("L"))
        *source =
            book->get_ref<const std::string &>() + ", " + source->get_ref<const std::string &>();
    }
  auto options = layer.find("options");
  if (options != layer.end() && options->is_object())
    for (Json &option : *options)
      if (option.is_null())
        option = "";
}

llvm::Error collect(llvm::StringRef id, const DialectSource &source, Layers &layers) {
  std::string wanted = id.str();
  std::vector<std::string> seen;
  while (!wanted.empty()) {
    if (llvm::is_contained(seen, wanted) || seen.size() == maxExtends)
      return llvm::createStringError(std::errc::invalid_argument,
                                     "%s: extends itself by way of \"%s\"",
                                     layers.files.front().name.c_str(), wanted.c_str());
    auto file = source(wanted);
    if (!file && layers.files.empty())
      return llvm::createStringError(std::errc::invalid_argument, "unknown dialect \"%s\"",
                                     wanted.c_str());
    if (!file) {
      const JsonLayer &user = layers.files.front();
      JsonStep step;
      step.key = "extends";
      return llvm::createStringError(
          std::errc::invalid_argument, "%s:%u: extends: unknown dialect \"%s\"", user.name.c_str(),
          lineAt(user.text, findJsonPlace(user.text, step).value_or(0)), wanted.c_str());
    }
    llvm::Expected<Json> value = parseJson(file->first, file->second);
    if (!value)
      return value.takeError();
    seen.push_back(wanted);
    layers.files.insert(layers.files.begin(), {file->first, file->second});
    JsonReader reader(llvm::makeArrayRef(layers.files).take_front(1), *value);
    wanted.clear();
    if (reader.isObject(*value))
      reader.read(*value, "extends", wanted);
    if (llvm::Error error = reader.takeError())
      return error;
    prepareLayer(*value);
    layers.values.insert(layers.values.begin(), std::move(*value));
  }
  return llvm::Error::success();
}

Json merge(std::vector<Json> &&values) {
  Json merged = Json::object();
  for (Json &value : values) {
    for (const Field &field : dialectRecord.fields)
      if (field.own) // said of one table alone: a table that extends it has its own
        merged.erase(field.key.str());
    layOver(merged, std::move(value));
  }
  return merged;
}

llvm::Expected<std::shared_ptr<Dialect>> build(llvm::ArrayRef<JsonLayer> files,
                                               const Json &merged) {
  auto dialect = std::make_shared<Dialect>();
  DialectBuilder builder(files, merged, *dialect);
  builder.build();
  if (llvm::Error error = builder.takeError())
    return error;
  return dialect;
}

/// The profile's codes as a fragment of a dialect: names in full, `summary` as `title`.
Json profileCodes(const Json &profile) {
  Json fragment = Json::object();
  if (!profile.is_object() || !profile.contains("codes") || !profile["codes"].is_object())
    return fragment;
  Json &codes = fragment["codes"] = Json::object();
  for (auto entry = profile["codes"].begin(); entry != profile["codes"].end(); ++entry) {
    std::optional<CodeName> name = parseCodeName(entry.key());
    std::string key = name ? toString(*name) : entry.key();
    Json code = *entry;
    if (code.is_object() && code.contains("summary")) {
      code["title"] = code["summary"];
      code.erase("summary");
    }
    codes[key] = std::move(code);
  }
  return fragment;
}

/// A code that does something else on this machine keeps nothing of what the control says of it.
void dropRedefined(Json &merged, const Json &fragment) {
  if (!fragment.contains("codes") || !merged.contains("codes"))
    return;
  Json &known = merged["codes"];
  for (auto entry = fragment["codes"].begin(); entry != fragment["codes"].end(); ++entry) {
    auto old = known.find(entry.key());
    if (old == known.end() || !entry->is_object() || !entry->contains("does"))
      continue;
    if (!old->contains("does") || (*old)["does"] != (*entry)["does"])
      known.erase(old);
  }
}

/// Lays over the table what its layers say of the control that the profile names. `controls` are
/// those of each layer, base first.
llvm::Error selectControl(Json &merged, llvm::ArrayRef<Json> controls, const Json &profile,
                          const JsonLayer &file) {
  JsonReader reader(file, profile);
  const Json *options = reader.member(profile, "options");
  const Json *control =
      options && options->is_object() ? reader.member(*options, "control") : nullptr;
  if (controls.empty() || !control || !control->is_string())
    return reader.takeError();
  const auto &name = control->get_ref<const std::string &>();
  std::vector<llvm::StringRef> known;
  bool found = false;
  for (const Json &layer : controls)
    for (auto entry = layer.begin(); entry != layer.end(); ++entry) {
      known.push_back(entry.key());
      if (entry.key() != name)
        continue;
      found = true;
      Json own = *entry;
      prepareLayer(own);
      layOver(merged, std::move(own));
    }
  if (!found)
    reader.fail(*control, "unknown control" + suggest(name, known));
  return reader.takeError();
}

/// Lays over the table what its layers say of the values that the profile gives to options.
/// `choices` are those of each layer, base first.
void selectOptions(Json &merged, llvm::ArrayRef<Json> choices, const Json &profile) {
  const auto options = profile.is_object() ? profile.find("options") : profile.end();
  if (options == profile.end() || !options->is_object())
    return;
  for (const Json &layer : choices)
    for (auto option = layer.begin(); option != layer.end(); ++option) {
      const auto given = options->find(option.key());
      const auto own = given == options->end() || !option->is_object()
                           ? option->end()
                           : option->find(optionText(*given));
      if (own == option->end())
        continue;
      Json laid = *own;
      prepareLayer(laid);
      layOver(merged, std::move(laid));
    }
}

/// Whether the profile changes no more of the table than values of options: then the table need not
/// be made anew of its layers.
bool leavesTable(const Dialect &dialect, const Json &profile) {
  if (!profile.is_object() || profile.contains("codes"))
    return false;
  const auto options = profile.find("options");
  if (options == profile.end())
    return true;
  if (!options->is_object() || options->contains("control"))
    return false;
  return llvm::none_of(dialect.layers, [&](const TableLayer &layer) {
    const auto choices = findJsonMember(layer.text, "byOption");
    if (!choices)
      return false;
    const Json value = Json::parse(choices->begin(), choices->end(), nullptr, false);
    if (!value.is_object())
      return true; // the long way tells what is wrong with it
    return llvm::any_of(options->items(),
                        [&](const auto &given) { return value.contains(given.key()); });
  });
}

/// The block that the control runs before every program says which modes are in force.
void startState(Dialect &dialect, JsonReader &reader, const Json &block) {
  llvm::SmallVector<llvm::StringRef, 8> words;
  llvm::SplitString(block.get_ref<const std::string &>(), words);
  for (const llvm::StringRef word : words) {
    const CodeIndex code = dialect.find(word);
    const GroupIndex group = code == noCode ? noGroup : dialect.codes[code].group;
    if (group == noGroup)
      return reader.fail(block, llvm::Twine("\"") + word + "\" is no code of a modal group");
    dialect.groups[group].initial = dialect.codes[code].bit;
  }
}

/// Options of the profile over the dialect's defaults; the dialect's table names all that there
/// are.
llvm::Error layOptions(Dialect &dialect, const Json &profile, const JsonLayer &file) {
  JsonReader reader(file, profile);
  std::vector<llvm::StringRef> known;
  for (const auto &option : dialect.options)
    known.push_back(option.getKey());
  llvm::sort(known);
  const Json *options = reader.member(profile, "options");
  if (!options || !reader.isObject(*options))
    return reader.takeError();
  for (auto entry = options->begin(); entry != options->end(); ++entry) {
    if (!llvm::is_contained(known, llvm::StringRef(entry.key())))
      reader.fail(*entry, "unknown option of " + dialect.id + suggest(entry.key(), known));
    else
      dialect.options[entry.key()] = optionText(*entry);
  }
  if (const Json *block = reader.member(*options, "priorityBlock"); block && block->is_string())
    startState(dialect, reader, *block);
  if (reader.member(*options, "mCodesPerBlock"))
    reader.readWhole(*options, "mCodesPerBlock", dialect.limits.mCodesPerBlock, 0, 100);
  return reader.takeError();
}

} // namespace

DialectSource builtinDialects() {
  return [](llvm::StringRef id) -> std::optional<std::pair<std::string, llvm::StringRef>> {
    std::string name = "dialects/" + id.str() + ".json";
    for (const RulesetFile &file : builtinRulesetFiles())
      if (file.name == name)
        return std::pair(name, file.text);
    return std::nullopt;
  };
}

llvm::Expected<std::shared_ptr<const Dialect>> loadDialect(llvm::StringRef id,
                                                           const DialectSource &source) {
  Layers layers;
  if (llvm::Error error = collect(id, source, layers))
    return error;
  Json merged = merge(std::move(layers.values));
  auto dialect = build(layers.files, merged);
  if (!dialect)
    return dialect.takeError();
  for (const JsonLayer &file : layers.files) {
    auto kept = std::make_shared<const std::string>(file.text);
    (*dialect)->layers.push_back({file.name, *kept, kept});
  }
  return std::shared_ptr<const Dialect>(std::move(*dialect));
}

llvm::Expected<std::shared_ptr<const Dialect>> overlay(std::shared_ptr<const Dialect> dialect,
                                                       llvm::StringRef name, llvm::StringRef text) {
  llvm::Expected<Json> profile = parseJson(name, text);
  if (!profile)
    return profile.takeError();
  if (leavesTable(*dialect, *profile)) {
    auto same = std::make_shared<Dialect>(*dialect);
    if (llvm::Error error = layOptions(*same, *profile, {name.str(), text}))
      return error;
    return std::shared_ptr<const Dialect>(std::move(same));
  }
  std::vector<JsonLayer> files;
  std::vector<Json> values, controls, choices;
  for (const TableLayer &layer : dialect->layers) {
    llvm::Expected<Json> value = parseJson(layer.name, layer.text);
    if (!value)
      return value.takeError();
    files.push_back({layer.name, layer.text});
    prepareLayer(*value);
    // What is taken away there must still be said when it is laid over the whole.
    if (const auto own = value->find("controls"); own != value->end() && own->is_object())
      controls.push_back(*own);
    if (const auto own = value->find("byOption"); own != value->end() && own->is_object())
      choices.push_back(*own);
    values.push_back(std::move(*value));
  }
  Json merged = merge(std::move(values));
  if (llvm::Error error = selectControl(merged, controls, *profile, {name.str(), text}))
    return error;
  selectOptions(merged, choices, *profile);
  Json fragment = profileCodes(*profile);
  dropRedefined(merged, fragment);
  layOver(merged, std::move(fragment));
  files.push_back({name.str(), text});
  auto result = build(files, merged);
  if (!result)
    return result.takeError();
  (*result)->layers = dialect->layers;
  if (llvm::Error error = layOptions(**result, *profile, files.back()))
    return error;
  return std::shared_ptr<const Dialect>(std::move(*result));
}

llvm::Expected<DialectSummary> summarize(llvm::StringRef name, llvm::StringRef text) {
  // Only the members at the top are parsed: the codes, nine tenths of a table, are skipped over.
  Json head = Json::object();
  constexpr llvm::StringRef keys[] = {"id", "title", "extends", "abstract", "detect"};
  for (const auto &[key, member] : llvm::zip(keys, findJsonMembers(text, keys)))
    if (member) {
      Json value = Json::parse(member->begin(), member->end(), nullptr, false);
      if (value.is_discarded())
        return parseJson(name, text).takeError();
      head[key.str()] = std::move(value);
    }
  JsonLayer layer{name.str(), text};
  JsonReader reader(layer, head);
  DialectSummary summary;
  reader.read(head, "id", summary.id);
  reader.read(head, "title", summary.title);
  reader.read(head, "extends", summary.extends);
  reader.read(head, "abstract", summary.abstract);
  if (const Json *detect = reader.member(head, "detect"))
    readDetection(reader, *detect, summary.detect, summary.extensions);
  if (llvm::Error error = reader.takeError())
    return error;
  return summary;
}

std::vector<DialectSummary> listDialects() {
  std::vector<DialectSummary> list;
  for (const RulesetFile &file : builtinRulesetFiles()) {
    if (!file.name.startswith("dialects/"))
      continue;
    if (llvm::Expected<DialectSummary> summary = summarize(file.name, file.text))
      list.push_back(std::move(*summary));
    else
      llvm::consumeError(summary.takeError()); // a test loads every built-in table
  }
  llvm::sort(list, [](const auto &left, const auto &right) { return left.id < right.id; });
  return list;
}

} // namespace ncvet
