// The program's entry: hands the command line over.
#include "analyzer/cli/command_line.h"

int main(int argc, char **argv) { return ncvet::cli::runCommandLine(argc, argv); }
