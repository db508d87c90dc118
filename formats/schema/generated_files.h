// The files below rulesets/ that are made of the records.
#pragma once

#include <string>
#include <vector>

namespace ncvet {

struct GeneratedFile {
  std::string name; ///< path below rulesets/
  std::string text;
};

std::vector<GeneratedFile> generatedFiles();

} // namespace ncvet
