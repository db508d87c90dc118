// What a client says when it asks for a path.
#pragma once

#include <string>

namespace ncvet::lsp {

struct PathWish {
  std::string previous; ///< id of the answer that it has
  bool pieces = false;  ///< it asks again as long as there is `more`
};

} // namespace ncvet::lsp
