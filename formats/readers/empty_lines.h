// Passes over lines in which there is nothing but blanks and comments.
#pragma once

#include "formats/readers/block_cursor.h"
#include "formats/readers/quick_reader.h"
#include "formats/text/byte_search.h"

namespace ncvet {

/// The lines from `offset` on that are nothing but blanks and comments, at most to `limit`, at
/// which a line begins or the text ends. `comment` gives the place after the comment at a place, or
/// the place itself where none is that can be passed over.
template <bool (*Blank)(char), typename Comment>
EmptyLines passEmptyLines(const char *base, uint32_t offset, uint32_t limit, Comment comment) {
  const char *const end = base + limit;
  const char *line = base + offset; // where the line begins that is looked at
  uint32_t count = 0;
  for (const char *at = line; at < end;) {
    if (isLineEnd(*at)) {
      at += *at == '\r' && at + 1 < end && at[1] == '\n' ? 2 : 1;
      line = at;
      ++count;
    } else if (Blank(*at)) {
      ++at;
    } else {
      const char *const after = comment(at);
      if (after == at)
        break;
      at = after;
    }
  }
  return {uint32_t(line - base), count};
}

} // namespace ncvet
