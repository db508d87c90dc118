#include "tests/support/places.h"

namespace ncvet::places {

std::string sourceFolder() { return NCVET_SOURCE_DIR; }

std::string program() { return NCVET_BINARY; }

std::string crashingProgram() { return NCVET_CRASHING_BINARY; }

std::vector<std::string> compiler() {
  std::vector<std::string> words = {NCVET_COMPILER, "-std=c++20"};
  for (const char *folder : {NCVET_INCLUDES})
    words.push_back(std::string("-I") + folder);
  return words;
}

} // namespace ncvet::places
