// A part program that is written to a file, and its blocks counted.
#pragma once

#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace ncvet::bench {

/// A file that is written block by block. Any failure ends the process: there is nothing to
/// measure.
class ProgramFile {
public:
  explicit ProgramFile(const std::string &path) : file_(std::fopen(path.c_str(), "wb")) {
    if (!file_) {
      std::perror(path.c_str());
      std::exit(2);
    }
    std::setvbuf(file_, nullptr, _IOFBF, size_t{1} << 20);
  }
  ProgramFile(const ProgramFile &) = delete;
  ProgramFile &operator=(const ProgramFile &) = delete;
  ~ProgramFile() {
    if (std::fclose(file_) != 0) {
      std::perror("close");
      std::exit(2);
    }
  }

  /// One line that is a block, by the format of `printf`, its end included.
  __attribute__((format(printf, 2, 3))) void block(const char *format, ...) {
    ++blocks_;
    std::va_list values;
    va_start(values, format);
    std::vfprintf(file_, format, values);
    va_end(values);
    std::fputc('\n', file_);
  }
  /// One line that is no block of its own: `%`, a comment.
  void line(const char *text) {
    std::fputs(text, file_);
    std::fputc('\n', file_);
  }
  /// What begins a program whose control knows its programs by their numbers.
  void head(int number, const char *name) {
    line("%");
    block("O%04d (%s)", number, name);
  }
  /// Blocks so far.
  uint64_t blocks() const { return blocks_; }

private:
  std::FILE *file_;
  uint64_t blocks_ = 0;
};

} // namespace ncvet::bench
