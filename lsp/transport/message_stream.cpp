// Framed messages: `Content-Length: N`, an empty line, N bytes.
#include "lsp/transport/message_stream.h"

#include "formats/text/system/system.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/StringExtras.h"

#include <algorithm>
#include <optional>

namespace ncvet::lsp {

namespace {

/// Whether a header may have a field of this name.
bool isFieldName(llvm::StringRef name) {
  return !name.empty() && llvm::all_of(name, [](char c) { return llvm::isAlnum(c) || c == '-'; });
}

} // namespace

bool MessageReader::fill() {
  if (at_ == buffer_.size()) {
    buffer_.clear();
    at_ = 0;
  }
  constexpr size_t piece = 64u << 10;
  const size_t had = buffer_.size();
  buffer_.resize(had + piece);
  const size_t got = system::readSome(descriptor_, buffer_.data() + had, piece);
  buffer_.resize(had + got);
  return got > 0;
}

/// Reads up to the next line end, which is dropped; false at the end of input.
bool MessageReader::readLine(std::string &line, bool &tooLong) {
  line.clear();
  tooLong = false;
  while (true) {
    const size_t end = buffer_.find('\n', at_);
    const size_t upTo = std::min(end, buffer_.size());
    const size_t room = mostHeaderBytes - line.size();
    tooLong |= upTo - at_ > room;
    line.append(buffer_, at_, std::min(upTo - at_, room));
    at_ = upTo;
    if (end != std::string::npos) {
      at_ = end + 1;
      if (!line.empty() && line.back() == '\r')
        line.pop_back();
      return true;
    }
    if (!fill())
      return false;
  }
}

/// Reads `count` bytes into `into`, or passes them over when that is null.
bool MessageReader::readBytes(uint64_t count, std::string *into) {
  while (count > 0) {
    if (at_ == buffer_.size() && !fill())
      return false;
    const size_t piece = std::min<uint64_t>(count, buffer_.size() - at_);
    if (into)
      into->append(buffer_, at_, piece);
    at_ += piece;
    count -= piece;
  }
  return true;
}

MessageReader::Result MessageReader::read(std::string &body) {
  std::string line;
  std::optional<uint64_t> length;
  llvm::StringRef wrong;
  bool any = false;
  while (true) {
    bool tooLong = false;
    if (!readLine(line, tooLong))
      return Result::End;
    if (line.empty()) {
      if (!any && wrong.empty())
        continue; // blank lines before a header do no harm
      break;
    }
    const auto [name, value] = llvm::StringRef(line).split(':');
    if (name.trim().equals_insensitive("content-length")) {
      any = true;
      uint64_t number = 0;
      if (value.trim().getAsInteger(10, number))
        wrong = "the value of Content-Length is no number";
      else
        length = number;
    } else if (isFieldName(name.trim()) && name.size() < line.size()) {
      any = true; // the type of the content, or what only another one knows
    } else {
      // What follows is not framed: the next header is looked for line by line.
      body = "not a header of a message";
      return Result::Bad;
    }
  }
  if (wrong.empty() && !length)
    wrong = "a message without Content-Length";
  if (wrong.empty() && *length > mostBytes) {
    if (!readBytes(*length, nullptr))
      return Result::End;
    wrong = "the message is too long";
  }
  if (!wrong.empty()) {
    body = wrong.str();
    return Result::Bad;
  }
  body.clear();
  body.reserve(std::min<uint64_t>(*length, 1u << 20)); // what was promised need not come
  return readBytes(*length, &body) ? Result::Message : Result::End;
}

void MessageWriter::write(llvm::StringRef body) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (broken_)
    return;
  const std::string header = "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n";
  broken_ = !system::writeAll(descriptor_, header) || !system::writeAll(descriptor_, body);
}

} // namespace ncvet::lsp
