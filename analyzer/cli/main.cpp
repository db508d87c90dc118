// Entry point of ncvet: hands the command line over and returns its exit code.
#include "analyzer/cli/command_line.h"
#include "formats/text/system/system.h"

int main(int argc, char **argv) {
  const auto words = ncvet::system::arguments(argc, argv);
  return ncvet::cli::runCommandLine(int(words.size()), words.data());
}
