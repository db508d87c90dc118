// Changed lines: reading unified diffs, and asking git for them.
#include "analyzer/cli/changes.h"

#include "formats/text/failure.h"
#include "formats/text/read_file.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"
#include "llvm/Support/Program.h"

namespace ncvet::cli {

namespace {

namespace fs = llvm::sys::fs;
namespace path = llvm::sys::path;

/// Of a whole repository that is checked in anew.
constexpr uint64_t largestPatch = 1u << 30;
/// Seconds that git may take.
constexpr unsigned gitTime = 60;

std::string realPathOf(llvm::StringRef file) {
  llvm::SmallString<256> real;
  return fs::real_path(file, real) ? file.str() : std::string(real);
}

/// A path as git quotes it when it has special characters: "a\tb", with octal codes of bytes.
std::string unquoted(llvm::StringRef text) {
  if (!text.consume_front("\"") || !text.consume_back("\""))
    return text.str();
  std::string out;
  for (size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '\\' || at + 1 == text.size()) {
      out.push_back(text[at]);
      continue;
    }
    unsigned code = 0;
    if (!text.substr(at + 1, 3).getAsInteger(8, code)) {
      out.push_back(char(code));
      at += 3;
      continue;
    }
    const size_t known = llvm::StringRef("abtnvfr").find(text[++at]);
    out.push_back(known == llvm::StringRef::npos ? text[at] : "\a\b\t\n\v\f\r"[known]);
  }
  return out;
}

/// The path after `+++ `: without the prefix of the new side, and without what follows a tabulator.
/// Empty: the file is gone.
std::string newPath(llvm::StringRef text) {
  if (!text.startswith("\""))
    text = text.split('\t').first;
  std::string name = unquoted(text.rtrim("\r"));
  if (name == "/dev/null")
    return "";
  llvm::StringRef rest = name;
  rest.consume_front("b/");
  return rest.str();
}

/// A part of a patch: `@@ -12,3 +14 @@`, and how many of its lines are still to come.
struct Hunk {
  uint32_t first = 0, oldLines = 0, newLines = 0;

  bool readHead(llvm::StringRef line) {
    if (!line.consume_front("@@ -"))
      return false;
    const auto [before, after] = line.split(" +");
    uint32_t ignored = 0;
    return readSide(before, ignored, oldLines) && readSide(after.split(' ').first, first, newLines);
  }

  /// The last new line. Where lines were only taken away, the ones round the gap count.
  uint32_t last() const { return newLines ? first + newLines - 1 : first + 1; }
  /// Whether the line is one of it.
  bool take(llvm::StringRef line) {
    if (!oldLines && !newLines)
      return false;
    const char kind = line.empty() ? ' ' : line.front();
    oldLines -= oldLines && (kind == ' ' || kind == '-');
    newLines -= newLines && (kind == ' ' || kind == '+');
    return true;
  }

private:
  static bool readSide(llvm::StringRef text, uint32_t &begin, uint32_t &count) {
    const auto [line, lines] = text.split(',');
    count = 1;
    return !line.getAsInteger(10, begin) && (lines.empty() || !lines.getAsInteger(10, count));
  }
};

/// What git prints; an error is its first line.
llvm::Expected<std::string> git(llvm::ArrayRef<llvm::StringRef> arguments) {
  auto program = llvm::sys::findProgramByName("git");
  if (!program)
    return failure("--changed-since needs git, which is not in the PATH");
  llvm::SmallString<128> out, err;
  if (fs::createTemporaryFile("ncvet-git", "out", out) ||
      fs::createTemporaryFile("ncvet-git", "err", err))
    return failure("--changed-since: no temporary file can be made");
  llvm::SmallVector<llvm::StringRef, 12> words = {"git", "-c", "core.quotePath=false"};
  words.append(arguments.begin(), arguments.end());
  const llvm::Optional<llvm::StringRef> streams[] = {llvm::StringRef(""), llvm::StringRef(out),
                                                     llvm::StringRef(err)};
  const int code = llvm::sys::ExecuteAndWait(*program, words, llvm::None, streams, gitTime);
  auto text = readFile(out, largestPatch), wrong = readFile(err);
  fs::remove(out);
  fs::remove(err);
  if (!text || !wrong || code != 0) {
    const std::string said =
        wrong ? (*wrong)->getBuffer().split('\n').first.str() : std::string("git failed");
    llvm::consumeError(text.takeError());
    llvm::consumeError(wrong.takeError());
    return failure("--changed-since: " + (said.empty() ? std::string("git failed") : said));
  }
  return (*text)->getBuffer().str();
}

} // namespace

void ChangedLines::add(llvm::StringRef root, llvm::StringRef name, uint32_t first, uint32_t last) {
  llvm::SmallString<256> file = root;
  path::append(file, name);
  files_[realPathOf(file)].emplace_back(first, last);
}

llvm::Expected<ChangedLines> ChangedLines::ofPatch(llvm::StringRef patch, llvm::StringRef root) {
  ChangedLines changes;
  std::string file;
  Hunk hunk;
  bool any = patch.trim().empty();
  for (uint32_t number = 1; !patch.empty(); ++number) {
    llvm::StringRef line;
    std::tie(line, patch) = patch.split('\n');
    if (hunk.take(line)) // whatever it looks like
      continue;
    if (line.consume_front("+++ ")) {
      file = newPath(line);
      any = true;
    } else if (line.startswith("@@ -")) {
      if (!hunk.readHead(line))
        return failure("line " + llvm::Twine(number) + " of the patch is no head of a hunk");
      if (!file.empty())
        changes.add(root, file, hunk.first, hunk.last());
    }
  }
  if (!any)
    return failure("it is no unified diff");
  return changes;
}

llvm::Expected<ChangedLines> ChangedLines::since(const std::string &commit) {
  if (llvm::StringRef(commit).startswith("-"))
    return failure("--changed-since wants a commit, not \"" + commit + "\"");
  auto root = git({"rev-parse", "--show-toplevel"});
  if (!root)
    return root.takeError();
  const llvm::StringRef folder = llvm::StringRef(*root).rtrim();
  // No program that a configuration of the repository names is run.
  auto patch = git({"diff", "--unified=0", "--no-color", "--no-ext-diff", "--no-textconv",
                    "--no-renames", "--src-prefix=a/", "--dst-prefix=b/", commit, "--"});
  if (!patch)
    return patch.takeError();
  auto changes = ofPatch(*patch, folder);
  if (!changes)
    return changes.takeError();
  auto fresh = git({"-C", folder, "ls-files", "--others", "--exclude-standard"});
  if (!fresh)
    return fresh.takeError();
  for (llvm::StringRef rest = *fresh; !rest.empty();) {
    llvm::StringRef name;
    std::tie(name, rest) = rest.split('\n');
    if (!name.empty())
      changes->add(folder, unquoted(name), 1, UINT32_MAX);
  }
  return changes;
}

bool ChangedLines::touches(const SourceFile &file, const SourceRange &range) const {
  const auto known = files_.find(realPathOf(file.path().empty() ? file.display() : file.path()));
  if (known == files_.end())
    return false;
  const uint32_t first = file.position(range.begin).line,
                 last = file.position(std::max(range.begin, range.end)).line;
  return llvm::any_of(known->second, [&](const std::pair<uint32_t, uint32_t> &lines) {
    return first <= lines.second && lines.first <= last;
  });
}

bool ChangedLines::concern(const SourceSet &sources, const Finding &finding) const {
  const auto changed = [&](const SourceRange &range) {
    return touches(sources.get(range.file), range);
  };
  return changed(finding.range) ||
         llvm::any_of(finding.notes, [&](const Note &note) { return changed(note.range); }) ||
         llvm::any_of(finding.path, [&](const PathStep &step) { return changed(step.range); });
}

std::string projectRoot() {
  llvm::SmallString<256> at;
  if (fs::current_path(at))
    return ".";
  for (llvm::StringRef folder = at; !folder.empty(); folder = path::parent_path(folder)) {
    llvm::SmallString<256> git = folder;
    path::append(git, ".git");
    if (fs::exists(git))
      return folder.str();
  }
  return std::string(at);
}

} // namespace ncvet::cli
