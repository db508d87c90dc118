// Reads the built-in table of detection.
#include "formats/dialect/config_file.h"
#include "formats/dialect/json_reader.h"
#include "formats/dialect/ruleset_files.h"

#include <nlohmann/json.hpp>

namespace ncvet {

llvm::Expected<DetectFile> loadDetection() {
  DetectFile table;
  for (const RulesetFile &file : builtinRulesetFiles()) {
    if (file.name != "detect.json")
      continue;
    auto json = parseJson(file.name, file.text);
    if (!json)
      return json.takeError();
    const JsonLayer layer{file.name.str(), file.text};
    JsonReader in(layer, *json);
    readInto(in, *json, detectRecord, table);
    if (llvm::Error wrong = in.takeError())
      return wrong;
  }
  return table;
}

} // namespace ncvet
