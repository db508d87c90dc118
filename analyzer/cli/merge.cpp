// `ncvet merge`: JSON reports or SARIF logs of the shards of a check made one.
#include "analyzer/cli/merge.h"

#include "analyzer/cli/output.h"
#include "formats/dialect/json_reader.h"
#include "formats/text/failure.h"
#include "formats/text/json_text.h"
#include "formats/text/read_file.h"

#include "llvm/Support/raw_ostream.h"
#include <nlohmann/json.hpp>

#include <map>
#include <set>

namespace ncvet::cli {

namespace {

using OrderedJson = nlohmann::ordered_json; // keys in the order of insertion

/// A report of a million findings has a gibibyte.
constexpr uint64_t largestReport = 2ull << 30;

llvm::Expected<OrderedJson> readReport(const std::string &file) {
  auto text = readFile(file, largestReport);
  if (!text)
    return text.takeError();
  const llvm::StringRef bytes = (*text)->getBuffer();
  if (nestsTooDeep(bytes))
    return failure(file + ": brackets nest too deep");
  OrderedJson json = OrderedJson::parse(bytes.begin(), bytes.end(), nullptr, false);
  if (json.is_discarded()) {
    auto wrong = parseJson(file, bytes); // names the line
    return wrong ? failure(file + ": it is no JSON") : wrong.takeError();
  }
  return json;
}

/// The list under `key`; an empty one when there is none.
OrderedJson listOf(const OrderedJson &object, const char *key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_array() ? *found : OrderedJson::array();
}

/// The object under `key`; an empty one when there is none.
OrderedJson objectOf(const OrderedJson &object, const char *key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_object() ? *found : OrderedJson::object();
}

std::string textOf(const OrderedJson &object, const char *key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

int64_t numberOf(const OrderedJson &object, const char *key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_number_integer() ? found->get<int64_t>() : 0;
}

/// Adds what `target` has not: a subprogram is told of by every part whose programs call it.
/// `keyOf` names an element.
void addNew(OrderedJson &target, const OrderedJson &list, std::set<std::string> &known,
            llvm::function_ref<std::string(const OrderedJson &)> keyOf) {
  for (const OrderedJson &element : list)
    if (known.insert(keyOf(element)).second)
      target.push_back(element);
}

/// Reports of version 1: lists are joined and put in order, the summary is counted again.
class JsonMerger {
public:
  llvm::Error add(const std::string &file, const OrderedJson &report) {
    if (numberOf(report, "version") != 1)
      return failure(file + ": it is no report of version 1 and no SARIF log");
    if (tool_.is_null())
      tool_ = objectOf(report, "tool");
    for (const char *key : lists)
      addNew(merged_[key], listOf(report, key), known_[key],
             [&](const OrderedJson &element) { return keyOf(key, element); });
    const OrderedJson summary = objectOf(report, "summary");
    suppressed_ += numberOf(summary, "suppressed");
    baseline_ += numberOf(summary, "known");
    return llvm::Error::success();
  }

  void write(llvm::raw_ostream &out) {
    out << "{\"version\":1,\"tool\":" << jsonText(tool_);
    for (const char *key : lists) {
      OrderedJson &list = merged_[key];
      std::vector<OrderedJson> sorted(list.begin(), list.end());
      llvm::stable_sort(sorted, [](const OrderedJson &a, const OrderedJson &b) {
        return placeOf(a) < placeOf(b);
      });
      out << ",\n\"" << key << "\":[";
      llvm::StringRef separator = "\n";
      for (const OrderedJson &element : sorted) {
        out << separator << jsonText(element);
        separator = ",\n";
      }
      out << "\n]";
    }
    out << ",\n\"summary\":" << jsonText(summary()) << "}\n";
  }

private:
  static constexpr const char *lists[] = {"files", "findings", "absent", "problems"};

  using Place = std::tuple<std::string, int64_t, int64_t, std::string, std::string>;
  static Place placeOf(const OrderedJson &element) {
    return {textOf(element, "path"), numberOf(element, "line"), numberOf(element, "column"),
            textOf(element, "rule"), textOf(element, "message")};
  }
  static std::string keyOf(llvm::StringRef list, const OrderedJson &element) {
    if (list != "findings")
      return jsonText(element);
    // Parts may have found it along different paths, and then the first one tells it.
    const auto [path, line, column, rule, message] = placeOf(element);
    return path + '\n' + std::to_string(line) + ':' + std::to_string(column) + '\n' + rule + '\n' +
           std::to_string(numberOf(element, "endLine")) + ':' +
           std::to_string(numberOf(element, "endColumn"));
  }

  OrderedJson summary() {
    std::map<std::string, size_t> severities, fixes;
    for (const OrderedJson &finding : merged_["findings"]) {
      ++severities[textOf(finding, "severity")];
      const auto fix = finding.find("fix");
      if (fix != finding.end() && !listOf(*fix, "edits").empty())
        ++fixes[textOf(*fix, "safety")];
    }
    return {{"files", merged_["files"].size()},
            {"findings", merged_["findings"].size()},
            {"errors", severities["error"]},
            {"warnings", severities["warning"]},
            {"style", severities["style"]},
            {"suppressed", suppressed_},
            {"known", baseline_},
            {"absent", merged_["absent"].size()},
            {"fixes", {{"safe", fixes["safe"]}, {"unsafe", fixes["unsafe"]}}}};
  }

  OrderedJson tool_;
  std::map<std::string, OrderedJson> merged_;
  std::map<std::string, std::set<std::string>> known_;
  int64_t suppressed_ = 0, baseline_ = 0;
};

/// SARIF logs of ncvet with one run each: code hosts want one run of a tool. Indexes of rules and
/// artifacts are given anew.
class SarifMerger {
public:
  llvm::Error add(const std::string &file, const OrderedJson &log) {
    const OrderedJson runs = listOf(log, "runs");
    if (runs.size() != 1 || !runs[0].is_object())
      return failure(file + ": a SARIF log with one run is expected");
    if (log_.is_null()) {
      log_ = log;
      for (const char *key : {"invocations", "artifacts", "results"})
        log_["runs"][0][key] = OrderedJson::array();
      log_["runs"][0]["tool"]["driver"]["rules"] = OrderedJson::array();
    }
    OrderedJson &target = log_["runs"][0];
    const OrderedJson &run = runs[0];
    if (run.contains("originalUriBaseIds"))
      target["originalUriBaseIds"] = run["originalUriBaseIds"];
    for (const OrderedJson &invocation : listOf(run, "invocations"))
      target["invocations"].push_back(renumbered(invocation));
    for (const OrderedJson &artifact : listOf(run, "artifacts"))
      renumbered(objectOf(artifact, "location"), listOf(artifact, "roles"));
    const OrderedJson rules = listOf(objectOf(objectOf(run, "tool"), "driver"), "rules");
    addNew(target["tool"]["driver"]["rules"], rules, ruleIds_,
           [](const OrderedJson &rule) { return textOf(rule, "id"); });
    addNew(target["results"], renumbered(listOf(run, "results")), results_, resultKey);
    return llvm::Error::success();
  }

  void write(llvm::raw_ostream &out) {
    OrderedJson &run = log_["runs"][0];
    std::map<std::string, size_t> index;
    for (const OrderedJson &rule : run["tool"]["driver"]["rules"])
      index.emplace(textOf(rule, "id"), index.size());
    for (OrderedJson &result : run["results"])
      if (const auto rule = index.find(textOf(result, "ruleId")); rule != index.end())
        result["ruleIndex"] = rule->second;
    run["artifacts"] = artifacts_;
    out << jsonText(log_) << '\n';
  }

private:
  static std::string resultKey(const OrderedJson &result) {
    return textOf(result, "ruleId") + '\n' + jsonText(listOf(result, "locations")) + '\n' +
           textOf(result, "baselineState");
  }

  /// The index of the artifact, which is added when it is new.
  size_t renumbered(const OrderedJson &location, const OrderedJson &roles) {
    const std::string uri = textOf(location, "uri");
    const auto [known, isNew] = artifactIndex_.try_emplace(uri, artifacts_.size());
    if (isNew) {
      OrderedJson artifact = {{"location", location}};
      artifact["location"]["index"] = known->second;
      artifact["roles"] = roles.empty() ? OrderedJson::array({"tracedFile"}) : roles;
      artifacts_.push_back(std::move(artifact));
    } else if (!roles.empty() && roles[0] == "analysisTarget") {
      artifacts_[known->second]["roles"] = roles; // what else it is for other parts
    }
    return known->second;
  }

  /// `value` with the new indexes in all locations of artifacts that are in it. Depth is bounded:
  /// deeper texts were refused.
  OrderedJson renumbered(OrderedJson value) {
    if (value.is_object() && value.contains("uri") && value.contains("index"))
      value["index"] = renumbered(value, OrderedJson::array());
    if (value.is_structured())
      for (OrderedJson &child : value)
        if (child.is_structured())
          child = renumbered(std::move(child));
    return value;
  }

  OrderedJson log_, artifacts_ = OrderedJson::array();
  std::map<std::string, size_t> artifactIndex_;
  std::set<std::string> ruleIds_, results_;
};

} // namespace

MergeCommand::MergeCommand()
    : Command("merge", "make one JSON report or SARIF log of those of the parts of a check") {
  options.section("Options");
  options.add("--output", &output_, "write to a file instead of standard output")
      .valued("FILE")
      .shortly('o');
  options.operands("FILE", files_, 1, size_t(-1));
}

int MergeCommand::run() {
  JsonMerger reports;
  SarifMerger logs;
  std::optional<bool> sarif;
  for (const std::string &file : files_) {
    auto json = readReport(file);
    if (!json)
      return fail(json.takeError());
    const bool isSarif = json->is_object() && json->contains("runs");
    if (sarif.value_or(isSarif) != isSarif)
      return fail(file + ": SARIF logs and JSON reports cannot be merged");
    sarif = isSarif;
    if (llvm::Error wrong = isSarif ? logs.add(file, *json) : reports.add(file, *json))
      return fail(std::move(wrong));
  }
  const auto write = [&](llvm::raw_ostream &out) {
    if (*sarif)
      logs.write(out);
    else
      reports.write(out);
  };
  if (llvm::Error wrong = writeFile(output_, write))
    return fail(std::move(wrong));
  return exitClean;
}

} // namespace ncvet::cli
