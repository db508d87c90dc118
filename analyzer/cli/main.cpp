// Entry point of ncvet: hands the command line over and returns its exit code.
#include "analyzer/cli/command_line.h"

int main(int argc, char **argv) { return ncvet::cli::runCommandLine(argc, argv); }
