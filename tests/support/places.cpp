#include "tests/support/places.h"

namespace ncvet::places {

std::string sourceFolder() { return NCVET_SOURCE_DIR; }

std::string program() { return NCVET_BINARY; }

std::string crashingProgram() { return NCVET_CRASHING_BINARY; }

} // namespace ncvet::places
