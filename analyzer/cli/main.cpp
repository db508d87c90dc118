// ncvet: the program.
#include "analyzer/cli/command_line.h"

int main(int argc, char **argv) { return ncvet::cli::runCommandLine(argc, argv); }
