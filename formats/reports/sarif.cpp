// Report as SARIF 2.1.0, written one result at a time, as a large program may have many.
#include "formats/finding/fingerprint.h"
#include "formats/finding/page_text.h"
#include "formats/reports/writers.h"
#include "formats/text/file_uri.h"
#include "formats/text/percent.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringMap.h"
#include "llvm/Support/Path.h"
#include <nlohmann/json.hpp>

#include <map>
#include <set>

namespace ncvet {

namespace {

using Json = nlohmann::ordered_json; // keys in the order of insertion

constexpr const char *schemaUri =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";
/// Where to learn about the tool when it has no page of its own: the URI is the information.
constexpr const char *ownInformation =
    "data:text/plain,ncvet%20vets%20NC%20part%20programs.%20See%20%60ncvet%20--help%60%20and%20"
    "%60ncvet%20explain%20RULE%60.";
/// What relative paths are relative to, by the name that code hosts know: the root of the project.
/// Its own path stays out of the report, which is to be the same on every machine.
constexpr const char *rootId = "%SRCROOT%";
/// Snippets longer than this many bytes help nobody.
constexpr uint32_t longestSnippet = 400;

llvm::StringRef levelOf(Severity severity) {
  return severity == Severity::Style ? "note" : toString(severity);
}

/// `cycle-unintended-execution` as `CycleUnintendedExecution`, SARIF's form of a rule's name.
std::string pascalCase(llvm::StringRef id) {
  std::string out;
  bool upper = true;
  for (const char letter : id) {
    if (llvm::isAlnum(letter))
      out.push_back(upper ? llvm::toUpper(letter) : letter);
    upper = !llvm::isAlnum(letter);
  }
  return out;
}

/// `text` without a final period: a summary has one, a message none unless it ends in a number.
llvm::StringRef withoutPeriod(llvm::StringRef text) {
  text.consume_back(".");
  return text;
}

/// `text` with one final period: SARIF has plain text in sentences.
std::string sentence(llvm::StringRef text) { return (withoutPeriod(text) + ".").str(); }

Json message(llvm::StringRef text) { return {{"text", sentence(text)}}; }

/// A result's message, both as text and as the rule's only message string with its argument.
Json resultMessage(llvm::StringRef text) {
  return {{"id", "default"},
          {"arguments", Json::array({withoutPeriod(text).str()})},
          {"text", sentence(text)}};
}

/// A URI reference as RFC 3986 writes it: percent-encoded, without `.` segments.
std::string uriOf(llvm::StringRef path) {
  llvm::SmallString<128> clean = path;
  llvm::sys::path::remove_dots(clean, /*remove_dot_dot=*/false);
  if (llvm::sys::path::is_absolute(clean))
    return uriOfPath(clean);
  std::string out;
  appendPercentEncoded(out, slashed(clean));
  return out;
}

bool isAbsoluteUri(llvm::StringRef uri) {
  return uri.startswith("https://") || uri.startswith("http://");
}

/// A file that the report speaks of, and what it was in the run, in SARIF's words.
struct Artifact {
  std::string path;
  llvm::StringRef role;
};

class SarifRun {
public:
  SarifRun(const Report &report, llvm::raw_ostream &out) : report_(report), out_(out) {
    collectArtifacts();
    for (const Finding &finding : report_.findings)
      suppressionsUsed_ |= finding.suppressed;
    collectRules();
  }

  void write() {
    out_ << "{\"$schema\":\"" << schemaUri << "\",\n\"version\":\"2.1.0\",\n\"runs\":[{\"tool\":";
    dumpJson(tool(), out_);
    out_ << ",\n\"invocations\":[";
    dumpJson(invocation(), out_);
    out_ << "],\n\"columnKind\":\"unicodeCodePoints\"";
    if (usesRoot_) {
      out_ << ",\n\"originalUriBaseIds\":";
      dumpJson({{rootId, {{"description", message("The root of the project")}}}}, out_);
    }
    writeArtifacts();
    writeResults();
    out_ << "}]}\n";
  }

private:
  void collectArtifacts() {
    // The roles by path. What was asked for is a target, whatever else it is.
    std::map<std::string, llvm::StringRef> roles;
    for (const FileReport &file : report_.files)
      roles.try_emplace(file.path, "analysisTarget");
    for (const Notification &notification : report_.notifications)
      if (!notification.path.empty())
        roles.try_emplace(notification.path, "analysisTarget");
    const auto add = [&](const SourceRange &range, llvm::StringRef role) {
      roles.try_emplace(fileOf(report_, range).display(), role);
    };
    for (const Finding &finding : report_.findings)
      add(finding.range, "resultFile");
    for (const AbsentFinding &finding : report_.absent)
      roles.try_emplace(finding.path, "resultFile");
    for (const Finding &finding : report_.findings) {
      for (const Note &note : finding.notes)
        add(note.range, "tracedFile");
      for (const PathStep &step : finding.path)
        add(step.range, "tracedFile");
      if (finding.fix)
        for (const TextEdit &edit : finding.fix->edits)
          add(edit.range, "tracedFile");
    }
    for (const auto &[path, role] : roles) {
      artifactIndex_.try_emplace(path, artifacts_.size());
      artifacts_.push_back({path, role});
      usesRoot_ |= !llvm::sys::path::is_absolute(pathFromRoot(report_, path));
    }
  }

  /// The rules that results name: the pages of all the others would be most of the report.
  void collectRules() {
    std::set<RuleId> used;
    for (const Finding &finding : report_.findings)
      used.insert(finding.rule);
    for (const AbsentFinding &finding : report_.absent)
      for (size_t rule = 0; report_.baselineUsed && rule < report_.rules.size(); ++rule)
        if (report_.rules[rule].id == finding.rule)
          used.insert(RuleId(rule));
    for (const RuleId rule : used)
      ruleIndex_.try_emplace(rule, ruleIndex_.size());
    for (const FileReport &file : report_.files)
      if (!llvm::is_contained(controls_, file.dialect))
        controls_.push_back(file.dialect);
  }

  Json artifactLocation(llvm::StringRef path) const {
    Json result = Json::object();
    const std::string shown = pathFromRoot(report_, path);
    result["uri"] = uriOf(shown);
    if (!llvm::sys::path::is_absolute(shown))
      result["uriBaseId"] = rootId;
    result["index"] = artifactIndex_.lookup(path);
    return result;
  }

  /// The rule's page for readers, with the programs of the controls that were checked; where it has
  /// none of them, with those of one control.
  std::string helpOf(const RuleInfo &rule) const {
    const llvm::StringRef body = splitPage(rule.help).second;
    if (body.empty())
      return rule.summary.str();
    const std::vector<std::string> known = controlsOfPrograms(body);
    std::vector<std::string> wanted;
    for (const std::string &control : known)
      if (llvm::is_contained(controls_, control))
        wanted.push_back(control);
    if (wanted.empty() && !known.empty())
      wanted.push_back(known.front());
    return forReaders(withProgramsOf(wanted, body));
  }

  std::string helpUriOf(const RuleInfo &rule) const {
    return isAbsoluteUri(report_.toolUri)
               ? report_.toolUri + "/rules/" + rule.id.str() + ".html"
               : "data:text/plain,See%20%60ncvet%20explain%20" + rule.id.str() + "%60.";
  }

  Json ruleJson(const RuleInfo &rule) const {
    Json result = Json::object();
    result["id"] = rule.id.str();
    result["name"] = pascalCase(rule.id);
    result["shortDescription"] = message(rule.summary);
    result["fullDescription"] = message(rule.summary);
    // The messages are made where the rule sees the program, so that the form is all of it.
    result["messageStrings"] = {{"default", {{"text", "{0}."}}}};
    const std::string help = helpOf(rule);
    result["help"] = {{"text", help}, {"markdown", help}};
    result["helpUri"] = helpUriOf(rule);
    result["defaultConfiguration"] = {{"enabled", rule.enabledByDefault},
                                      {"level", levelOf(rule.severity).str()}};
    result["properties"] = {{"tags", Json::array({rule.category.str()})}};
    return result;
  }

  Json tool() const {
    Json driver = Json::object();
    driver["name"] = report_.toolName;
    driver["version"] = report_.toolVersion;
    driver["semanticVersion"] = report_.toolVersion;
    driver["informationUri"] = isAbsoluteUri(report_.toolUri) ? report_.toolUri : ownInformation;
    Json rules = Json::array();
    for (const auto &[rule, index] : ruleIndex_)
      rules.push_back(ruleJson(report_.rules[rule]));
    driver["rules"] = std::move(rules);
    Json result = Json::object();
    result["driver"] = std::move(driver);
    return result;
  }

  Json notificationJson(Severity severity, const std::string &text, llvm::StringRef path) const {
    Json result = Json::object();
    if (!path.empty())
      result["locations"] =
          Json::array({{{"physicalLocation", {{"artifactLocation", artifactLocation(path)}}}}});
    result["message"] = message(text);
    result["level"] = levelOf(severity).str();
    return result;
  }

  Json invocation() const {
    Json notifications = Json::array();
    bool successful = true;
    for (const Notification &notification : report_.notifications) {
      successful &= notification.severity != Severity::Error;
      notifications.push_back(
          notificationJson(notification.severity, notification.message, notification.path));
    }
    for (const FileReport &file : report_.files)
      if (!file.complete)
        notifications.push_back(notificationJson(
            Severity::Warning, "analysis cut short: findings may be missing", file.path));
    Json result = Json::object();
    result["executionSuccessful"] = successful;
    result["toolExecutionNotifications"] = std::move(notifications);
    return result;
  }

  void writeArtifacts() {
    out_ << ",\n\"artifacts\":[";
    llvm::StringRef separator = "\n";
    for (const Artifact &artifact : artifacts_) {
      out_ << separator;
      dumpJson({{"location", artifactLocation(artifact.path)},
                {"roles", Json::array({artifact.role.str()})}},
               out_);
      separator = ",\n";
    }
    out_ << "\n]";
  }

  Json regionJson(const SourceRange &range, bool withSnippet) const {
    const Region region = regionOf(report_, range);
    Json result = Json::object();
    result["startLine"] = region.begin.line;
    result["startColumn"] = region.begin.column;
    result["endLine"] = region.end.line;
    result["endColumn"] = region.end.column;
    if (withSnippet && !range.empty() && range.end - range.begin <= longestSnippet) {
      const SourceFile &file = fileOf(report_, range);
      result["snippet"] = {{"text", file.displayText(file.text(range.begin, range.end))}};
    }
    return result;
  }

  Json location(const SourceRange &range, bool withSnippet = false) const {
    Json result = Json::object();
    result["physicalLocation"] = {
        {"artifactLocation", artifactLocation(fileOf(report_, range).display())},
        {"region", regionJson(range, withSnippet)}};
    return result;
  }

  Json locationWithMessage(const SourceRange &range, llvm::StringRef text) const {
    Json result = location(range);
    result["message"] = message(validText(report_, range, text));
    return result;
  }

  /// The steps that lead to the finding, and the finding itself as the last one.
  Json codeFlow(const Finding &finding) const {
    Json steps = Json::array();
    for (const PathStep &step : finding.path)
      steps.push_back({{"location", locationWithMessage(step.range, step.message)}});
    steps.push_back({{"location", locationWithMessage(finding.range, finding.message)}});
    return {{"threadFlows", Json::array({{{"locations", std::move(steps)}}})}};
  }

  Json fixJson(const Fix &fix, const SourceRange &range) const {
    // One change a file, in the order in which the files are first edited.
    Json changes = Json::array();
    llvm::DenseMap<FileId, size_t> changeOf;
    for (const TextEdit &edit : fix.edits) {
      const auto [entry, isNew] = changeOf.try_emplace(edit.range.file, changes.size());
      if (isNew)
        changes.push_back(
            {{"artifactLocation", artifactLocation(fileOf(report_, edit.range).display())},
             {"replacements", Json::array()}});
      Json replacement = Json::object();
      replacement["deletedRegion"] = regionJson(edit.range, /*withSnippet=*/false);
      if (!edit.text.empty())
        replacement["insertedContent"] = {{"text", validText(report_, edit.range, edit.text)}};
      changes[entry->second]["replacements"].push_back(std::move(replacement));
    }
    Json result = Json::object();
    result["description"] = message(validText(report_, range, fix.description));
    result["artifactChanges"] = std::move(changes);
    result["properties"] = {{"safety", toString(fix.safety).str()}};
    return result;
  }

  /// GitHub looks for `primaryLocationLineHash`, and would otherwise make one of the line's text,
  /// which a new block number changes.
  static Json fingerprints(uint64_t fingerprint) {
    const std::string text = fingerprintString(fingerprint);
    return {{"primaryLocationLineHash", text + ":1"}, {"ncvet/v1", text}};
  }

  Json resultJson(const Finding &finding) const {
    const RuleInfo &rule = report_.rules[finding.rule];
    const std::string text = validText(report_, finding.range, finding.message);
    Json result = Json::object();
    result["ruleId"] = rule.id.str();
    result["ruleIndex"] = ruleIndex_.at(finding.rule);
    result["level"] = levelOf(finding.severity).str();
    result["message"] = resultMessage(text);
    result["locations"] = Json::array({location(finding.range, /*withSnippet=*/true)});
    if (!finding.notes.empty()) {
      Json related = Json::array();
      for (const Note &note : finding.notes)
        related.push_back(locationWithMessage(note.range, note.message));
      result["relatedLocations"] = std::move(related);
    }
    if (!finding.path.empty())
      result["codeFlows"] = Json::array({codeFlow(finding)});
    if (finding.fix && !finding.fix->edits.empty())
      result["fixes"] = Json::array({fixJson(*finding.fix, finding.range)});
    result["partialFingerprints"] = fingerprints(finding.fingerprint);
    // Where one result tells of suppressions, all have to.
    if (suppressionsUsed_)
      result["suppressions"] = finding.suppressed
                                   ? Json::array({{{"kind", "inSource"}, {"status", "accepted"}}})
                                   : Json::array();
    if (report_.baselineUsed)
      result["baselineState"] = finding.baselined ? "unchanged" : "new";
    result["properties"] = {{"certainty", toString(finding.certainty).str()}};
    return result;
  }

  Json absentJson(const AbsentFinding &finding) const {
    Json result = Json::object();
    result["ruleId"] = finding.rule;
    result["message"] = message(finding.message);
    for (const auto &[rule, index] : ruleIndex_)
      if (report_.rules[rule].id == finding.rule) {
        result["ruleIndex"] = index;
        result["message"] = resultMessage(finding.message);
      }
    result["locations"] = Json::array({{{"physicalLocation",
                                         {{"artifactLocation", artifactLocation(finding.path)},
                                          {"region", {{"startLine", finding.line}}}}}}});
    result["partialFingerprints"] = fingerprints(finding.fingerprint);
    if (suppressionsUsed_)
      result["suppressions"] = Json::array();
    result["baselineState"] = "absent";
    return result;
  }

  void writeResults() {
    out_ << ",\n\"results\":[";
    llvm::StringRef separator = "\n";
    const auto writeOne = [&](const Json &result) {
      out_ << separator;
      dumpJson(result, out_);
      separator = ",\n";
    };
    for (const Finding &finding : report_.findings)
      writeOne(resultJson(finding));
    if (report_.baselineUsed)
      for (const AbsentFinding &finding : report_.absent)
        writeOne(absentJson(finding));
    out_ << "\n]";
  }

  const Report &report_;
  llvm::raw_ostream &out_;
  std::vector<Artifact> artifacts_;       ///< in the order of their paths
  llvm::StringMap<size_t> artifactIndex_; ///< by path
  std::map<RuleId, size_t> ruleIndex_;    ///< of the rules that results name
  std::vector<std::string> controls_;     ///< ids of the dialects of the files
  bool usesRoot_ = false;
  bool suppressionsUsed_ = false;
};

class SarifWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    SarifRun(report, out).write();
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeSarifWriter() { return std::make_unique<SarifWriter>(); }

} // namespace ncvet
