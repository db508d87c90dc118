// The settings of a check as a text, equal when a check of the same file finds the same under them.
#pragma once

#include "analyzer/program/lookup_answers.h"
#include "analyzer/setup/session.h"

namespace ncvet {

/// All of the options and of the configuration that findings rest on, and tables of one's own as
/// `answers` know them.
std::string settingsText(const SessionOptions &options, const Config &config,
                         LookupAnswers &answers);

} // namespace ncvet
