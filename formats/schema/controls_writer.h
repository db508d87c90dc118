// What is known of each control, from which source, and what is not: made of the tables.
#pragma once

#include <string>

namespace ncvet {

/// Markdown: a section for each control that can be chosen.
std::string controlsText();

} // namespace ncvet
