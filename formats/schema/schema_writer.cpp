// JSON Schemas of the tables: each record becomes a definition, each field a property.
#include "formats/schema/schema_writer.h"

#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

#include <cmath>

namespace ncvet {

namespace {

using Json = nlohmann::ordered_json;

class SchemaWriter {
public:
  Json write(const Record &root, llvm::StringRef name) {
    Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                   {"$id", ("https://ncvet.invalid/schema/" + name).str()},
                   {"title", root.meaning.str()}};
    schema.update(objectOf(root));
    schema["$defs"] = Json::object();
    // Definitions name further ones.
    for (size_t at = 0; at < records_.size(); ++at)
      schema["$defs"][records_[at]->name.str()] = objectOf(*records_[at]);
    const Json forms = shared();
    for (const auto &[key, value] : forms.items())
      schema["$defs"][key] = value;
    return schema;
  }

private:
  /// Forms that many keys have.
  static Json shared() {
    return {
        {"addresses",
         {{"description", "a set of addresses: letters and comma addresses as one string "
                          "(`XZ,R`), or a list of names; `#` is a number without an address"},
          {"anyOf", {{{"type", "string"}}, listOfTexts()}}}},
        {"texts", {{"anyOf", {{{"type", "string"}}, listOfTexts()}}}},
        {"formula", {{"description", "a formula over the words of the code"}, {"type", "string"}}}};
  }
  static Json listOfTexts() { return {{"type", "array"}, {"items", {{"type", "string"}}}}; }

  Json objectOf(const Record &record) {
    Json object = {{"description", record.meaning.str()}, {"type", "object"}};
    entriesInherited_ = record.laidOver;
    object["additionalProperties"] =
        record.others ? orNull(formOf(*record.others), record.laidOver) : Json(false);
    Json properties = Json::object(), required = Json::array();
    for (const Record *part = &record; part; part = part->base)
      for (const Field &field : part->fields) {
        if (field.shape.of && field.shape.of->record == &record)
          continue; // a variant has no variants
        properties[field.key.str()] = propertyOf(field, *part, record.laidOver);
        if (field.required && (field.own || !record.laidOver))
          required.push_back(field.key.str());
      }
    object["properties"] = std::move(properties);
    if (!required.empty())
      object["required"] = std::move(required);
    return object;
  }

  /// A key of `owner`, of which an overlay takes away what it inherits.
  Json propertyOf(const Field &field, const Record &owner, bool laidOver) {
    Json property = {{"description", field.meaning.str()}};
    property.update(orNull(formOf(field.shape), laidOver && !field.own));
    if (!field.example.empty())
      property["examples"] = Json::array({Json::parse(field.example.str(), nullptr, false)});
    const std::string fallback =
        field.fallback && owner.defaults ? field.fallback(field.shape, owner.defaults()) : "";
    if (!fallback.empty())
      property["default"] = Json::parse(fallback, nullptr, false);
    return property;
  }

  /// Null takes an inherited key away.
  static Json orNull(Json form, bool wanted) {
    if (!wanted)
      return form;
    if (form.contains("enum"))
      form["enum"].push_back(nullptr);
    else if (form.contains("type") && form["type"].is_string())
      form["type"] = {form["type"], "null"};
    else if (form.contains("type"))
      form["type"].push_back("null");
    else if (form.contains("anyOf"))
      form["anyOf"].push_back({{"type", "null"}});
    else
      form = {{"anyOf", {form, {{"type", "null"}}}}};
    return form;
  }

  Json formOf(const Shape &shape) {
    Json form = plainFormOf(shape);
    if (shape.otherwise)
      return {{"anyOf", {std::move(form), formOf(*shape.otherwise)}}};
    return form;
  }

  Json plainFormOf(const Shape &shape) {
    switch (shape.form) {
    case Form::Text:
      return shape.pattern ? Json{{"type", "string"}, {"pattern", shape.pattern}}
                           : Json{{"type", "string"}};
    case Form::Flag:
      return {{"type", "boolean"}};
    case Form::Number:
      return bounded({{"type", "number"}}, shape);
    case Form::Whole:
      return bounded({{"type", "integer"}}, shape);
    case Form::Name:
      return {{"enum", namesOf(shape)}};
    case Form::Texts:
      return {{"$ref", "#/$defs/texts"}};
    case Form::Addresses:
      return {{"$ref", "#/$defs/addresses"}};
    case Form::Formula:
      return {{"$ref", "#/$defs/formula"}};
    case Form::Scalar:
      return {{"type", {"boolean", "number", "string", "array"}}};
    case Form::List:
      return listOf(shape);
    case Form::Map:
      return mapOf(shape);
    case Form::Object:
      return {{"$ref", reference(*shape.record)}};
    }
    return {};
  }

  static Json namesOf(const Shape &shape) {
    Json names = Json::array();
    for (llvm::StringRef name : shape.names().drop_front(shape.firstName))
      names.push_back(name.str());
    return names;
  }

  static Json bounded(Json form, const Shape &shape) {
    if (std::isfinite(shape.least))
      form["minimum"] = int64_t(shape.least);
    if (std::isfinite(shape.most))
      form["maximum"] = int64_t(shape.most);
    return form;
  }

  Json listOf(const Shape &shape) {
    Json form = {{"type", "array"}, {"items", formOf(*shape.of)}};
    if (shape.fewest)
      form["minItems"] = shape.fewest;
    if (shape.many)
      form["maxItems"] = shape.many;
    return form;
  }

  Json mapOf(const Shape &shape) {
    Json form = {{"type", "object"}};
    if (shape.names)
      form["propertyNames"] = {{"enum", namesOf(shape)}};
    if (shape.pattern)
      form["propertyNames"] = {{"pattern", shape.pattern}};
    if (shape.of)
      form["additionalProperties"] = orNull(formOf(*shape.of), entriesInherited_);
    return form;
  }

  std::string reference(const Record &record) {
    if (std::find(records_.begin(), records_.end(), &record) == records_.end())
      records_.push_back(&record);
    return ("#/$defs/" + record.name).str();
  }

  std::vector<const Record *> records_; ///< that have a definition
  bool entriesInherited_ = false;       ///< entries of maps are laid over one another, one by one
};

} // namespace

std::string schemaText(const Record &record, llvm::StringRef name) {
  return SchemaWriter().write(record, name).dump(2) + "\n";
}

} // namespace ncvet
