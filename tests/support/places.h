#pragma once

#include <string>
#include <vector>

// Where the tests find what they run and read. Known to one file alone (places.cpp): the others
// compile to the same objects wherever the project is built, and the compiler's cache has them.
namespace ncvet::places {

/// The project's top folder, absolute, without a slash at its end.
std::string sourceFolder();

/// The ncvet that was built beside the tests, absolute.
std::string program();

/// The same with a rule that crashes when a program asks for it (support/crashing_rule.cpp).
std::string crashingProgram();

/// The compiler that built the tests, with the language and the folders of a rule's headers.
std::vector<std::string> compiler();

} // namespace ncvet::places
