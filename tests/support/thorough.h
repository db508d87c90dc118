// How much is tried: a share of it every day, all of it where NCVET_THOROUGH is set.
#pragma once

#include <cstdlib>

namespace ncvet::test {

/// `all` programs, seeds or steps where everything is to be tried, else `share` of them.
inline unsigned tried(unsigned share, unsigned all) {
  return std::getenv("NCVET_THOROUGH") ? all : share;
}

} // namespace ncvet::test
