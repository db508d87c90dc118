// Framed messages of the base protocol, read from and written to file descriptors.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <mutex>
#include <string>

namespace ncvet::lsp {

/// Reads messages: headers, an empty line, and as many bytes as `Content-Length` says.
class MessageReader {
public:
  enum class Result : uint8_t {
    Message,
    Bad, ///< not a message; what follows it and can be read as one is read next
    End
  };

  explicit MessageReader(int descriptor) : descriptor_(descriptor) {}

  /// Waits for the next message. Of a bad one `body` holds what is wrong.
  Result read(std::string &body);

  /// Longer messages are passed over: a program of 100 MB with its escapes fits.
  static constexpr uint64_t mostBytes = 512u << 20;
  /// A header field that is longer is no header field.
  static constexpr size_t mostHeaderBytes = 4096;

private:
  bool fill();
  bool readLine(std::string &line, bool &tooLong);
  bool readBytes(uint64_t count, std::string *into);

  int descriptor_;
  std::string buffer_;
  size_t at_ = 0; ///< first byte of `buffer_` that is not read yet
};

/// Writes messages, one at a time, from any thread.
class MessageWriter {
public:
  explicit MessageWriter(int descriptor) : descriptor_(descriptor) {}

  void write(llvm::StringRef body);
  /// True when nobody reads any more.
  bool isBroken() const { return broken_; }

private:
  int descriptor_;
  std::mutex mutex_;
  bool broken_ = false;
};

} // namespace ncvet::lsp
