// Looks at every byte of a text, and at those that a change touches.
#include "analyzer/program/file_scan.h"

#include "formats/readers/plain_number.h"
#include "formats/text/each_byte.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/StringExtras.h"

#include <cstring>

namespace ncvet {

namespace {

/// Places of one byte beyond so many are not kept.
constexpr size_t mostPlaces = 1u << 22;

/// Files with lone CR as line end are rare.
bool endsLinesByLineFeed(llvm::StringRef text, uint32_t begin) {
  return memchr(text.data() + begin, '\n', text.size() - begin) != nullptr;
}

/// Calls `visit(lineBegin, firstContent)` for every line of [begin, end) that is not blank. The
/// pages that lie after are given back meanwhile.
template <typename Visit>
void eachLine(const SourceFile &source, uint32_t begin, size_t end, bool lineFeeds, Visit visit) {
  const llvm::StringRef text = source.text();
  constexpr ptrdiff_t forgetStep = 4 << 20;
  const char *const base = text.data();
  const char *const stop = base + end;
  const char *line = base + begin;
  const char *forgotten = line;
  const auto look = [&] {
    if (line - forgotten >= forgetStep) {
      source.forget(uint32_t(line - base));
      forgotten = line;
    }
    const char *content = line;
    while (content < stop && uint8_t(*content) <= ' ' &&
           (*content == ' ' || *content == '\t' || *content == '\0'))
      ++content;
    if (content < stop)
      visit(uint32_t(line - base), uint32_t(content - base));
  };
  eachByte(line, stop, lineFeeds ? '\n' : '\r', [&](const char *next) {
    look();
    line = next + 1;
  });
  if (line < stop)
    look();
}

class HeadsOf {
public:
  HeadsOf(llvm::StringRef text, llvm::StringRef marks) : text_(text) {
    for (const char c : marks)
      isMark_[uint8_t(llvm::toUpper(c))] = isMark_[uint8_t(llvm::toLower(c))] = true;
  }
  std::optional<uint32_t> operator()(uint32_t line, uint32_t content) const {
    return isMark_[uint8_t(text_[content])] ? std::optional(line) : std::nullopt;
  }

  bool mayBeginWith(char c) const { return isMark_[uint8_t(c)]; }

private:
  llvm::StringRef text_;
  std::array<bool, 256> isMark_{};
};

class NumbersOf {
public:
  /// `mainBlocks`: the number of a main block comes after `:`.
  NumbersOf(llvm::StringRef text, bool mainBlocks) : text_(text), mainBlocks_(mainBlocks) {
    for (const char c : llvm::StringRef("/0123456789 {Nn:"))
      mayBegin_[uint8_t(c)] = true;
  }
  std::optional<NumberedBlock> operator()(uint32_t line, uint32_t at) const {
    if (!mayBegin_[uint8_t(text_[at])])
      return std::nullopt;
    // Block skip and comments in braces may be before the number.
    while (at < text_.size() &&
           (text_[at] == '/' || llvm::isDigit(text_[at]) || text_[at] == ' ' || text_[at] == '{'))
      if (text_[at++] == '{') {
        while (at < text_.size() && text_[at] != '}' && text_[at] != '\n')
          ++at;
        at += at < text_.size() && text_[at] == '}';
      }
    if (at >= text_.size() ||
        (text_[at] != 'N' && text_[at] != 'n' && !(mainBlocks_ && text_[at] == ':')))
      return std::nullopt;
    ++at;
    while (at < text_.size() && text_[at] == ' ')
      ++at;
    if (const auto number = shortNumber(at))
      return NumberedBlock{*number, line};
    int64_t number = 0;
    unsigned digits = 0;
    while (at < text_.size() && llvm::isDigit(text_[at]) && digits < 12) {
      number = number * 10 + (text_[at++] - '0');
      ++digits;
    }
    return digits ? std::optional(NumberedBlock{number, line}) : std::nullopt;
  }

  bool mayBeginWith(char c) const { return mayBegin_[uint8_t(c)]; }

private:
  /// A number of one to seven digits, read at once; none: it is another.
  std::optional<uint32_t> shortNumber(uint32_t at) const {
    constexpr uint64_t each = 0x0101010101010101;
    uint64_t bytes;
    if (std::endian::native != std::endian::little || text_.size() - at < sizeof bytes)
      return std::nullopt;
    std::memcpy(&bytes, text_.data() + at, sizeof bytes);
    bytes ^= each * '0';
    // The highest bit of each byte that is no digit.
    const uint64_t others = (((bytes & each * 0x7F) + each * 0x76) | bytes) & each * 0x80;
    const unsigned size = others ? unsigned(std::countr_zero(others)) & ~7u : 0; // in bits
    return size ? std::optional(eightDigits(bytes << (64 - size))) : std::nullopt;
  }

  llvm::StringRef text_;
  bool mainBlocks_;
  std::array<bool, 256> mayBegin_{};
};

template <typename Entry, typename Look>
std::vector<Entry> linesIn(const SourceFile &source, uint32_t begin, size_t end, bool lineFeeds,
                           const Look &look) {
  std::vector<Entry> found;
  eachLine(source, begin, end, lineFeeds, [&](uint32_t line, uint32_t content) {
    if (const auto entry = look(line, content))
      found.push_back(*entry);
  });
  return found;
}

/// The number of a main block comes after `:`, where that is no mark of a head.
bool hasMainBlocks(llvm::StringRef marks) { return !marks.contains(':'); }

uint32_t &offsetOf(uint32_t &offset) { return offset; }
uint32_t &offsetOf(NumberedBlock &block) { return block.offset; }

/// Entries of [begin, end) give way to `fresh`, those after move.
template <typename Entry>
void replace(std::vector<Entry> &entries, uint32_t begin, uint32_t end, const TextChange &change,
             const std::vector<Entry> &fresh) {
  const auto before = [](Entry entry, uint32_t offset) { return offsetOf(entry) < offset; };
  auto first = std::lower_bound(entries.begin(), entries.end(), begin, before);
  const auto last = std::lower_bound(first, entries.end(), end, before);
  if (change.end != change.endAfter())
    for (auto entry = last; entry != entries.end(); ++entry)
      offsetOf(*entry) = change.moved(offsetOf(*entry));
  const auto common = std::min(size_t(last - first), fresh.size());
  first = std::copy(fresh.begin(), fresh.begin() + ptrdiff_t(common), first);
  if (common < fresh.size())
    entries.insert(first, fresh.begin() + ptrdiff_t(common), fresh.end());
  else
    entries.erase(first, last);
}

} // namespace

const std::vector<uint32_t> &FileScan::heads(const SourceFile &source, llvm::StringRef marks) {
  if (!heads_ || marks_ != marks) {
    lineFeeds_ = endsLinesByLineFeed(source.text(), source.textBegin());
    if (marks_ != marks)
      numbers_.reset();
    marks_ = marks.str();
    source.forget(0);
    heads_.emplace();
    numbers_.emplace(); // which are asked for too, nearly always
    const HeadsOf headOf(source.text(), marks);
    const NumbersOf numberOf(source.text(), hasMainBlocks(marks_));
    std::array<bool, 256> mayBegin; // by far the most lines begin with neither
    for (size_t c = 0; c < mayBegin.size(); ++c)
      mayBegin[c] = headOf.mayBeginWith(char(c)) || numberOf.mayBeginWith(char(c));
    const char *const text = source.text().data();
    eachLine(source, source.textBegin(), source.text().size(), lineFeeds_,
             [&](uint32_t line, uint32_t content) {
               if (!mayBegin[uint8_t(text[content])])
                 return;
               if (const auto head = headOf(line, content))
                 heads_->push_back(*head);
               if (const auto number = numberOf(line, content))
                 numbers_->push_back(*number);
             });
  }
  return *heads_;
}

const std::vector<NumberedBlock> &FileScan::numbers(const SourceFile &source) {
  if (!numbers_) {
    lineFeeds_ = endsLinesByLineFeed(source.text(), source.textBegin());
    source.forget(0);
    numbers_ = linesIn<NumberedBlock>(source, source.textBegin(), source.text().size(), lineFeeds_,
                                      NumbersOf(source.text(), hasMainBlocks(marks_)));
  }
  return *numbers_;
}

const std::vector<uint32_t> *FileScan::places(const SourceFile &source, char c) {
  const auto [known, fresh] = places_.try_emplace(c);
  std::vector<uint32_t> &places = known->second;
  if (fresh)
    source.eachPlaceOf(c, [&](uint32_t place) {
      if (places.size() <= mostPlaces)
        places.push_back(place);
    });
  return places.size() > mostPlaces ? nullptr : &places;
}

const TextPiece &FileScan::pieceAt(const PieceReader &reader, uint32_t begin, uint32_t end) {
  if (const TextPiece *known = pieces_.find(begin); known && known->end <= end)
    return *known;
  pieces_.insert(reader.read(begin, std::min(end, pieces_.next(begin + 1))));
  return *pieces_.find(begin);
}

void FileScan::eachPiece(const PieceReader &reader, uint32_t begin, uint32_t end,
                         llvm::function_ref<bool(const TextPiece &)> visit) {
  for (uint32_t at = begin; at < end;) {
    const TextPiece &piece = pieceAt(reader, at, end);
    at = piece.end;
    if (!visit(piece))
      return;
  }
}

void FileScan::clear() {
  pieces_.clear();
  heads_.reset();
  numbers_.reset();
  places_.clear();
}

void FileScan::edit(const TextChange &change, const SourceFile &after) {
  const llvm::StringRef text = after.text();
  const uint32_t first = after.textBegin();
  if (change.begin < 3 || endsLinesByLineFeed(text, first) != lineFeeds_)
    return clear(); // a byte order mark may have come or gone
  const char ending = lineFeeds_ ? '\n' : '\r';
  const size_t front = text.rfind(ending, change.begin); // looks before it
  const uint32_t begin = std::max(first, front == llvm::StringRef::npos ? 0 : uint32_t(front + 1));
  const size_t back = text.find(ending, change.endAfter());
  const uint32_t end = uint32_t(back == llvm::StringRef::npos ? text.size() : back + 1);
  const uint32_t endBefore = end - change.endAfter() + change.end;
  if (heads_)
    replace(*heads_, begin, endBefore, change,
            linesIn<uint32_t>(after, begin, end, lineFeeds_, HeadsOf(text, marks_)));
  if (numbers_)
    replace(*numbers_, begin, endBefore, change,
            linesIn<NumberedBlock>(after, begin, end, lineFeeds_,
                                   NumbersOf(text, hasMainBlocks(marks_))));
  pieces_.edit([&](TextPiece &piece) {
    if (change.begin <= piece.end && change.end >= piece.begin)
      return true;
    if (piece.begin >= change.end)
      piece.move(change);
    return false;
  });
  for (auto known = places_.begin(); known != places_.end();) {
    auto &[c, places] = *known;
    std::vector<uint32_t> fresh;
    for (uint32_t at = change.begin; at < change.endAfter(); ++at)
      if (text[at] == c)
        fresh.push_back(at);
    if (places.size() > mostPlaces) {
      known = places_.erase(known);
      continue;
    }
    replace(places, change.begin, change.end, change, fresh);
    ++known;
  }
}

} // namespace ncvet
