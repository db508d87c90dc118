// Baseline: a JSON file of fingerprints, read and written.
#include "analyzer/check/baseline.h"

#include "formats/dialect/json_reader.h"
#include "formats/finding/fingerprint.h"
#include "formats/text/failure.h"
#include "formats/text/json_text.h"
#include "formats/text/read_file.h"

#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

constexpr int version = 1;
/// Of a million findings.
constexpr uint64_t largestBaseline = 512u << 20;

} // namespace

llvm::Expected<Baseline> Baseline::load(llvm::StringRef file) {
  auto buffer = readFile(file, largestBaseline);
  if (!buffer)
    return buffer.takeError();
  const llvm::StringRef text = (*buffer)->getBuffer();
  auto json = parseJson(file, text);
  if (!json)
    return json.takeError();
  const JsonLayer layer{file.str(), text};
  JsonReader in(layer, *json);
  in.allowKeys(*json, {"version", "findings"});
  int given = 0;
  in.readWhole(*json, "version", given, version, version);
  const Json *findings = in.member(*json, "findings");
  if (!in.failed() && (!given || !findings || !findings->is_array()))
    in.fail(*json, "a baseline has \"version\" 1 and a list of \"findings\"");
  Baseline baseline;
  if (!in.failed())
    for (const Json &element : *findings) {
      in.allowKeys(element, {"fingerprint", "count", "rule", "path", "line", "message"});
      KnownFinding entry;
      std::string fingerprint;
      in.read(element, "fingerprint", fingerprint);
      in.readWhole(element, "count", entry.count, 1, 1'000'000'000);
      in.read(element, "rule", entry.rule);
      in.read(element, "path", entry.path);
      in.readWhole(element, "line", entry.line, 1, 0xFFFFFFFF);
      in.read(element, "message", entry.message);
      if (llvm::StringRef(fingerprint).getAsInteger(16, entry.fingerprint))
        in.fail(element, "\"fingerprint\" has 16 hexadecimal digits");
      if (in.failed())
        break;
      const auto [known, isNew] = baseline.known_.try_emplace(entry.fingerprint, entry);
      if (!isNew)
        known->second.count += entry.count;
    }
  if (llvm::Error wrong = in.takeError())
    return wrong;
  return baseline;
}

void Baseline::apply(llvm::MutableArrayRef<Finding> findings) {
  for (Finding &finding : findings) {
    const auto known = known_.find(finding.fingerprint);
    if (known == known_.end() || known->second.count == 0)
      continue;
    --known->second.count;
    finding.baselined = true;
  }
}

std::vector<KnownFinding> Baseline::absent(const llvm::StringSet<> &files) const {
  std::vector<KnownFinding> list;
  for (const auto &[fingerprint, known] : known_)
    if (known.count > 0 && files.contains(known.path))
      list.push_back(known);
  return list;
}

void writeBaseline(llvm::ArrayRef<Finding> findings, llvm::ArrayRef<RuleInfo> rules,
                   const SourceSet &sources, llvm::raw_ostream &out) {
  std::map<uint64_t, unsigned> counts;
  for (const Finding &finding : findings)
    if (!finding.suppressed)
      ++counts[finding.fingerprint];
  out << "{\"version\": " << version << ", \"findings\": [";
  llvm::StringRef separator = "\n";
  for (const Finding &finding : findings) {
    const auto count = counts.find(finding.fingerprint);
    if (finding.suppressed || count == counts.end())
      continue; // an equal one is in the file already
    const SourceFile &source = sources.get(finding.range.file);
    nlohmann::ordered_json entry = {{"fingerprint", fingerprintString(finding.fingerprint)},
                                    {"rule", rules[finding.rule].id.str()},
                                    {"path", source.display()},
                                    {"line", source.position(finding.range.begin).line},
                                    {"message", source.displayText(finding.message)}};
    if (count->second != 1)
      entry["count"] = count->second;
    out << separator << jsonText(entry);
    separator = ",\n";
    counts.erase(count);
  }
  out << "\n]}\n";
}

} // namespace ncvet
