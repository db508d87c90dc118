// Writes the programs that the benchmarks run on: the same bytes every time, on every machine.
//
//   ncvet_bench_programs FOLDER [--big | --tenth]
//
// `programs.tsv` in the folder lists them: file, blocks that the control executes, dialect, and
// what is aimed at. `rs274.tsv` lists those that LinuxCNC's interpreter runs too, with the tools in
// `rs274.tbl`: what is aimed at is then how many times as fast. With --big there is one of ten
// million blocks; with --tenth all are a tenth as long.
#include "programs.h"

#include <functional>
#include <string_view>

using namespace ncvet::bench;

namespace {

using Writer = std::function<uint64_t(ProgramFile &)>;

/// Writes a program and its line of the table.
void list(std::FILE *table, const std::string &folder, const char *name, const char *dialect,
          const char *goal, const Writer &writer) {
  ProgramFile file(folder + "/" + name);
  const uint64_t blocks = writer(file);
  std::fprintf(table, "%s\t%llu\t%s\t%s\n", name, static_cast<unsigned long long>(blocks), dialect,
               goal);
}

std::FILE *openTable(const std::string &path) {
  std::FILE *const table = std::fopen(path.c_str(), "wb");
  if (!table)
    std::perror(path.c_str());
  return table;
}

/// The programs that LinuxCNC's interpreter runs too; false: they could not be written.
bool writeForInterpreter(const std::string &folder, uint64_t thousand) {
  std::FILE *const table = openTable(folder + "/rs274.tsv");
  if (!table)
    return false;
  const auto write = [&](const char *name, const char *goal, const Writer &writer) {
    list(table, folder, name, "linuxcnc", goal, writer);
  };
  writeToolTable(folder + "/rs274.tbl");
  write("surfacing-1m.ngc", "60", [&](auto &file) {
    return writeSurfacing(file, 1000 * thousand, Spelling::Modal, Frame::File);
  });
  write("numbered-1m.ngc", "60", [&](auto &file) {
    return writeSurfacing(file, 1000 * thousand, Spelling::Numbered, Frame::File);
  });
  write("contours-300k.ngc", "25",
        [&](auto &file) { return writeContours(file, 300 * thousand, Frame::File); });
  write("drilling-200k.ngc", "25",
        [&](auto &file) { return writeDrilling(file, 200 * thousand, Frame::File); });
  write("macros-400k.ngc", "10",
        [&](auto &file) { return writeBracketedMacros(file, 400 * thousand); });
  return std::fclose(table) == 0;
}

} // namespace

int main(int argc, char **argv) {
  const std::string_view option = argc == 3 ? argv[2] : "";
  if (argc < 2 || argc > 3 || (argc == 3 && option != "--big" && option != "--tenth")) {
    std::fputs("usage: ncvet_bench_programs FOLDER [--big | --tenth]\n", stderr);
    return 2;
  }
  const std::string folder = argv[1];
  std::FILE *const table = openTable(folder + "/programs.tsv");
  if (!table)
    return 2;
  const auto write = [&](const char *name, const char *dialect, const char *goal,
                         const Writer &writer) {
    list(table, folder, name, dialect, goal, writer);
  };
  const uint64_t share = option == "--tenth" ? 10 : 1;
  const uint64_t million = 1'000'000 / share, thousand = 1'000 / share;
  write("tiny.nc", "fanuc-0m", "", writeTiny);
  write("tiny.mpf", "sinumerik", "", writeTinySinumerik);
  write("surfacing-1m.nc", "fanuc-0m", "0.7 units",
        [&](auto &file) { return writeSurfacing(file, million, Spelling::Modal); });
  if (option == "--big")
    write("surfacing-10m.nc", "fanuc-0m", "0.7 units",
          [&](auto &file) { return writeSurfacing(file, 10 * million, Spelling::Modal); });
  write("numbered-1m.nc", "haas-mill", "0.9 units",
        [&](auto &file) { return writeSurfacing(file, million, Spelling::Numbered); });
  write("sinumerik-1m.mpf", "sinumerik", "0.9 units",
        [&](auto &file) { return writeSinumerikSurfacing(file, million); });
  write("contours-300k.nc", "fanuc-0m", "2.5 units",
        [&](auto &file) { return writeContours(file, 300 * thousand); });
  write("drilling-200k.nc", "fanuc-0m", "2.5 units",
        [&](auto &file) { return writeDrilling(file, 200 * thousand); });
  write("turning-300k.nc", "fanuc-0t", "2.5 units",
        [&](auto &file) { return writeTurning(file, 300 * thousand); });
  write("comments-1m.nc", "fanuc-0m", "0.6 units",
        [&](auto &file) { return writeCommented(file, million); });
  write("long-lines-50k.nc", "haas-mill", "1.2 units",
        [&](auto &file) { return writeLongLines(file, 50 * thousand); });
  write("macros-1m.nc", "fanuc-0m", "5 Mblocks/s",
        [&](auto &file) { return writeMacros(file, million); });
  write("subprograms-2k.nc", "fanuc-0m", "100 ms, 64 MiB",
        [&](auto &file) { return writeSubprograms(file, 2 * thousand); });
  return writeForInterpreter(folder, thousand) && std::fclose(table) == 0 ? 0 : 2;
}
