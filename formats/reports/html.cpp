// Report as one HTML page that needs nothing beside itself: programs, findings, tool paths.
#include "formats/reports/page_json.h"
#include "formats/reports/page_parts.h"
#include "formats/reports/viewer_files.h"
#include "formats/reports/writers.h"
#include "formats/text/json_text.h"

#include "llvm/ADT/StringMap.h"
#include "llvm/ADT/StringSet.h"
#include "llvm/Support/Base64.h"
#include "llvm/Support/SHA256.h"
#include <nlohmann/json.hpp>

namespace ncvet {

using Json = nlohmann::ordered_json; // keys in the order of insertion

namespace {

/// A browser runs only what has this hash: nothing that a program's text could smuggle in.
std::string hashOf(llvm::StringRef text) {
  const auto bytes = llvm::SHA256::hash(
      llvm::makeArrayRef(reinterpret_cast<const uint8_t *>(text.data()), text.size()));
  return "'sha256-" + llvm::encodeBase64(bytes) + "'";
}

/// All viewer files with this ending, one after the other.
std::string joined(llvm::StringRef ending) {
  std::string all;
  for (const ViewerFile &file : viewerFiles())
    if (file.name.endswith(ending))
      all += file.text;
  return all;
}

llvm::StringRef viewerFile(llvm::StringRef name) {
  for (const ViewerFile &file : viewerFiles())
    if (file.name == name)
      return file.text;
  return {};
}

class HtmlWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    report_ = &report;
    collectFiles();
    const std::string style = joined(".css");
    const std::string script = "'use strict';\n(() => {\n" + joined(".js") + "start();\n})();\n";
    llvm::StringRef page = viewerFile("page.html");
    while (!page.empty()) {
      const auto [before, rest] = page.split("{{");
      out << before;
      const auto [name, after] = rest.split("}}");
      page = after;
      if (name == "policy")
        out << "default-src 'none'; script-src " << hashOf(script) << "; style-src "
            << hashOf(style)
            << "; img-src data:; base-uri 'none'; form-action 'none'; "
               "require-trusted-types-for 'script'";
      else if (name == "style")
        out << style;
      else if (name == "script")
        out << script;
      else if (name == "data")
        writeData(out);
    }
  }

private:
  struct Shown {
    FileId file = 0;
    const ProgramView *view = nullptr;
  };

  /// The files whose text is shown: the checked ones first, then what findings and paths lead to.
  /// One that was read twice counts once.
  void collectFiles() {
    files_.clear();
    llvm::StringMap<size_t> known;
    const auto add = [&](FileId file, const ProgramView *view) {
      const auto [entry, isNew] =
          known.try_emplace(report_->sources->get(file).display(), files_.size());
      if (isNew)
        files_.push_back({file, view});
      else if (view && !files_[entry->second].view)
        files_[entry->second] = {file, view};
    };
    for (const ProgramView &view : report_->views)
      add(view.file, &view);
    for (const Finding &finding : report_->findings) {
      if (isHidden(finding))
        continue;
      add(finding.range.file, nullptr);
      for (const Note &note : finding.notes)
        add(note.range.file, nullptr);
      for (const PathStep &step : finding.path)
        add(step.range.file, nullptr);
    }
    for (const ProgramView &view : report_->views)
      if (view.path)
        for (const FileId file : view.path->files)
          add(file, nullptr);
  }

  void writeData(llvm::raw_ostream &out) {
    out << "<script type=\"application/json\" id=\"report\">";
    writeReport(out);
    out << "</script>\n";
    size_t budget = mostPageText, moves = mostPageMoves;
    for (size_t i = 0; i < files_.size(); ++i) {
      const Shown &shown = files_[i];
      out << "<script type=\"application/json\" id=\"text-" << i << "\">";
      writeTextJson(report_->sources->get(shown.file),
                    shown.view ? llvm::makeArrayRef(shown.view->colours)
                               : llvm::ArrayRef<TextColour>(),
                    budget, out);
      out << "</script>\n";
      if (!shown.view || !shown.view->path)
        continue;
      const size_t count = shown.view->path->programmed.moves.size();
      if (count > moves)
        continue;
      moves -= count;
      out << "<script type=\"application/json\" id=\"path-" << i << "\">";
      writeToolPathJson(*report_, *shown.view->path, out);
      out << "</script>\n";
    }
  }

  void writeReport(llvm::raw_ostream &out) {
    put({{"version", 1},
         {"tool", {{"name", report_->toolName}, {"version", report_->toolVersion}}}},
        out);
    out << ",\n\"colours\":[";
    llvm::StringRef separator;
    for (const llvm::StringLiteral &name : report_->colourNames) {
      out << separator << '"' << name << '"';
      separator = ",";
    }
    out << "],\n\"texts\":[";
    separator = "";
    for (const Shown &shown : files_) {
      writeJsonInPage(
          (separator + jsonText(Json(report_->sources->get(shown.file).display()))).str(), out);
      separator = ",";
    }
    out << "],\n\"files\":";
    writeFiles(out);
    out << ",\n\"rules\":";
    writeRules(out);
    out << ",\n\"notifications\":";
    Json notifications = Json::array();
    for (const Notification &notification : report_->notifications)
      notifications.push_back({{"severity", toString(notification.severity).str()},
                               {"message", notification.message},
                               {"path", notification.path}});
    writeJsonInPage(jsonText(notifications), out);
    out << ",\n\"findings\":[";
    separator = "\n";
    // One at a time: a file of a million blocks may have many.
    for (const Finding &finding : report_->findings) {
      if (isHidden(finding))
        continue;
      out << separator;
      writeJsonInPage(jsonText(findingJson(*report_, finding)), out);
      separator = ",\n";
    }
    out << "\n]}";
  }

  /// The members of an object that is not closed yet.
  static void put(const Json &object, llvm::raw_ostream &out) {
    writeJsonInPage(llvm::StringRef(jsonText(object)).drop_back(), out);
  }

  void writeFiles(llvm::raw_ostream &out) const {
    Json files = Json::array();
    for (const FileReport &file : report_->files)
      files.push_back({{"path", file.path},
                       {"dialect", file.dialect},
                       {"blocks", file.blocks},
                       {"complete", file.complete},
                       {"reason", file.detail},
                       {"guessed", file.guessed}});
    writeJsonInPage(jsonText(files), out);
  }

  void writeRules(llvm::raw_ostream &out) const {
    Json rules = Json::object();
    for (const Finding &finding : report_->findings)
      if (!isHidden(finding))
        rules[report_->rules[finding.rule].id.str()] = report_->rules[finding.rule].summary.str();
    writeJsonInPage(jsonText(rules), out);
  }

  const Report *report_ = nullptr;
  std::vector<Shown> files_;
};

} // namespace

std::unique_ptr<ReportWriter> makeHtmlWriter() { return std::make_unique<HtmlWriter>(); }

} // namespace ncvet
