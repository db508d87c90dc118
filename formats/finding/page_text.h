// A rule's page as people read it.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"

#include <string>
#include <utility>
#include <vector>

namespace ncvet {

/// Splits a page (Markdown) into the JSON text of its metadata, empty when it has none, and the
/// rest.
std::pair<llvm::StringRef, llvm::StringRef> splitPage(llvm::StringRef page);

/// Ids of the controls that programs of the page are for, in the order of the page, none twice.
std::vector<std::string> controlsOfPrograms(llvm::StringRef body);

/// The page's text with the programs of these controls only, and without what introduces others
/// alone: paragraphs, sentences that end in a colon, headings with nothing left below them.
/// Unchanged when it has no program of any of them.
std::string withProgramsOf(llvm::ArrayRef<std::string> controls, llvm::StringRef body);

/// The text without what is for the makers of ncvet: the marks of tests in programs and what their
/// heads tell the tests, and the places of manuals that a page rests on.
std::string forReaders(llvm::StringRef body);

} // namespace ncvet
