// Encodings of part programs: UTF-8, or one of two 8-bit code pages that old controls' PCs wrote.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <cstdint>
#include <string>

namespace ncvet {

/// How the bytes of a file are to be shown. Ranges are always bytes; this matters for display only.
enum class Encoding : uint8_t { Utf8, Windows1252, Windows1250 };

/// Length of the UTF-8 byte order mark at the begin of `text`: 3 or 0. Readers skip that many.
uint32_t byteOrderMark(llvm::StringRef text);

bool isAscii(llvm::StringRef bytes);
bool isValidUtf8(llvm::StringRef bytes);

/// The encoding that `text` is most likely in. UTF-8 when it is valid UTF-8; else the letters
/// decide between Western (1252) and Central European (1250), Western when they say nothing:
///  - for 1250: codes that 1252 leaves empty; S and Z with caron; codes that 1252 reads as signs
///    (superscripts, fractions, currency) amid letters; o and u with double acute; e with caron,
///    u with ring and n with caron inside a word;
///  - for 1252: the diameter sign before a number, a with ring, a with grave, superscript
///    two, one half.
Encoding guessEncoding(llvm::StringRef text);

/// Appends `bytes` as valid UTF-8. What has no character becomes U+FFFD.
void appendDecoded(std::string &out, llvm::StringRef bytes, Encoding encoding);

/// Code points in `bytes` of a text in `encoding`: for an 8-bit encoding the number of bytes.
uint32_t countCodePoints(llvm::StringRef bytes, Encoding encoding);

/// Bytes of the first code point of `bytes` (not empty) in `encoding`; 1 where there is none.
uint32_t codePointLength(llvm::StringRef bytes, Encoding encoding);

/// Appends one code point (no surrogate, at most U+10FFFF) as UTF-8.
void appendUtf8(std::string &out, uint32_t codePoint);

} // namespace ncvet
