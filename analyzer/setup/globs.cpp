// Globs of a configuration, compiled once.
#include "analyzer/setup/globs.h"

#include "formats/text/file_uri.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

#include <algorithm>

namespace ncvet {

Globs::Globs(llvm::ArrayRef<std::string> globs) {
  for (llvm::StringRef glob : globs) {
    if (!glob.contains('/')) {
      add(ofNames_, glob);
      continue;
    }
    const std::string whole = glob.endswith("/") ? (glob + "*").str() : glob.str();
    glob = whole;
    add(ofPaths_, glob);
    if (glob.consume_front("**/"))
      add(ofPaths_, glob);
  }
}

namespace {

/// Bytes of the glob's text that mean one character, or the star it begins with.
size_t firstToken(llvm::StringRef glob) {
  if (glob.front() == '\\')
    return std::min<size_t>(2, glob.size());
  if (glob.front() != '[')
    return 1;
  const size_t end = glob.find(']', 2); // a bracket that is first is a member
  return std::min(end, glob.size() - 1) + 1;
}

} // namespace

/// Many stars tried one inside the other would take a time that doubles with each of them. Of the
/// parts between them the first place that fits is as good as any other.
void Globs::add(std::vector<Glob> &globs, llvm::StringRef text) {
  texts_.push_back(text.str());
  llvm::StringRef rest = texts_.back();
  Glob glob;
  const char *begin = rest.begin();
  size_t length = 0;
  const auto close = [&](const char *end) {
    auto pattern = llvm::GlobPattern::create(llvm::StringRef(begin, size_t(end - begin)));
    if (!pattern) {
      llvm::consumeError(pattern.takeError());
      return false;
    }
    glob.push_back({length, std::move(*pattern)});
    length = 0;
    return true;
  };
  while (!rest.empty()) {
    const size_t bytes = firstToken(rest);
    const bool star = rest.front() == '*';
    if (star && !close(rest.begin()))
      return;
    rest = rest.drop_front(bytes);
    if (star)
      begin = rest.begin();
    else
      ++length;
  }
  if (close(rest.begin()))
    globs.push_back(std::move(glob));
}

bool Globs::matches(const Glob &glob, llvm::StringRef text) {
  const Piece &first = glob.front(), &last = glob.back();
  if (glob.size() == 1)
    return text.size() == first.length && first.pattern.match(text);
  if (text.size() < first.length + last.length ||
      !first.pattern.match(text.take_front(first.length)) ||
      !last.pattern.match(text.take_back(last.length)))
    return false;
  text = text.drop_front(first.length).drop_back(last.length);
  for (const Piece &piece : llvm::makeArrayRef(glob).drop_front().drop_back()) {
    while (text.size() >= piece.length && !piece.pattern.match(text.take_front(piece.length)))
      text = text.drop_front();
    if (text.size() < piece.length)
      return false;
    text = text.drop_front(piece.length);
  }
  return true;
}

bool Globs::match(llvm::StringRef path) const {
  const auto matchesIn = [](const std::vector<Glob> &globs, llvm::StringRef text) {
    return llvm::any_of(globs, [&](const Glob &glob) { return matches(glob, text); });
  };
  return matchesIn(ofPaths_, path) || matchesIn(ofNames_, llvm::sys::path::filename(path));
}

std::string pathBelow(llvm::StringRef folder, llvm::StringRef file) {
  llvm::SmallString<256> from(folder), to(file);
  const bool isFolder = file.endswith("/");
  if (llvm::sys::fs::make_absolute(from) || llvm::sys::fs::make_absolute(to))
    return file.str();
  llvm::sys::path::remove_dots(from, true);
  llvm::sys::path::remove_dots(to, true);
  const std::string whole = slashed(to);
  llvm::StringRef name = whole;
  if (name.consume_front(slashed(from)) && name.startswith("/"))
    name = name.ltrim('/');
  else
    name = whole;
  return isFolder ? (name + "/").str() : name.str();
}

} // namespace ncvet
