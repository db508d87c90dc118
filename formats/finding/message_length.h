// How much of a program a message quotes.
#pragma once

#include "formats/finding/finding.h"

namespace ncvet {

/// Characters of the program that one quotation shows: as much as a line of a terminal.
constexpr size_t mostQuoted = 80;

/// The message with each text between backticks cut to `mostQuoted` characters, the last three of
/// them points, and with no more than some lines in all.
std::string withShortQuotes(std::string message);

/// The same for all that the finding says.
void shortenQuotes(Finding &finding);

} // namespace ncvet
