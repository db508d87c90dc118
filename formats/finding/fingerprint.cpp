// Fingerprints: what goes into the hash, and how equal findings are told apart.
#include "formats/finding/fingerprint.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/Format.h"
#include "llvm/Support/raw_ostream.h"
#include "llvm/Support/xxhash.h"

#include <algorithm>

namespace ncvet {

std::string fingerprintText(const SourceFile &file, SourceRange block,
                            llvm::ArrayRef<SourceRange> leftOut) {
  std::string out;
  auto append = [&](uint32_t begin, uint32_t end) {
    for (char byte : file.text(begin, std::max(begin, end)))
      if (!llvm::isSpace(byte))
        out.push_back(llvm::toUpper(byte));
  };
  uint32_t at = block.begin;
  for (const SourceRange &part : leftOut) {
    append(at, std::min(part.begin, block.end));
    at = std::max(at, part.end);
  }
  append(at, block.end);
  // Every finding of the block holds a copy.
  constexpr size_t longest = 1024;
  if (out.size() > longest) {
    const uint64_t rest = llvm::xxHash64(llvm::StringRef(out).drop_front(longest));
    out.resize(longest);
    out += llvm::utohexstr(rest);
  }
  return out;
}

uint64_t Fingerprints::next(llvm::StringRef ruleId, llvm::StringRef program,
                            llvm::StringRef blockText) {
  // A zero byte between the parts: none of them ends with what the next one begins with.
  std::string key = (ruleId + llvm::Twine('\0') + program + llvm::Twine('\0') + blockText).str();
  uint64_t base = llvm::xxHash64(key);
  // Two values are reserved by the map.
  base = std::min(base, llvm::DenseMapInfo<uint64_t>::getTombstoneKey() - 1);
  const uint32_t ordinal = seen_[base]++;
  key.push_back('\0');
  key += llvm::utostr(ordinal);
  return llvm::xxHash64(key);
}

std::string fingerprintString(uint64_t fingerprint) {
  std::string out;
  llvm::raw_string_ostream stream(out);
  stream << llvm::format_hex_no_prefix(fingerprint, 16);
  return stream.str();
}

} // namespace ncvet
