// ncvet_schema FOLDER: writes the generated files of the tables below FOLDER, the project's
// rulesets/.
#include "formats/schema/generated_files.h"

#include <cstdio>
#include <fstream>

int main(int argc, char **argv) {
  if (argc != 2) {
    std::fputs("usage: ncvet_schema RULESETS-FOLDER\n", stderr);
    return 2;
  }
  for (const ncvet::GeneratedFile &file : ncvet::generatedFiles()) {
    const std::string path = std::string(argv[1]) + "/" + file.name;
    std::ofstream out(path, std::ios::binary);
    if (!(out << file.text) || !out.flush()) {
      std::fprintf(stderr, "cannot write %s\n", path.c_str());
      return 1;
    }
  }
  return 0;
}
