// Writes the programs that the benchmarks run on: the same bytes every time, on every machine.
//
//   ncvet_bench_programs FOLDER [--big | --tenth]
//
// `programs.tsv` in the folder lists them: file, blocks that the control executes, dialect, and
// what is aimed at. With --big there is one of ten million blocks; with --tenth all are a tenth as
// long.
#include "programs.h"

#include <functional>
#include <string_view>

using namespace ncvet::bench;

int main(int argc, char **argv) {
  const std::string_view option = argc == 3 ? argv[2] : "";
  if (argc < 2 || argc > 3 || (argc == 3 && option != "--big" && option != "--tenth")) {
    std::fputs("usage: ncvet_bench_programs FOLDER [--big | --tenth]\n", stderr);
    return 2;
  }
  const std::string folder = argv[1];
  const std::string tablePath = folder + "/programs.tsv";
  std::FILE *table = std::fopen(tablePath.c_str(), "wb");
  if (!table) {
    std::perror(tablePath.c_str());
    return 2;
  }
  using Writer = std::function<uint64_t(ProgramFile &)>;
  const auto write = [&](const char *name, const char *dialect, const char *goal,
                         const Writer &writer) {
    ProgramFile file(folder + "/" + name);
    const uint64_t blocks = writer(file);
    std::fprintf(table, "%s\t%llu\t%s\t%s\n", name, static_cast<unsigned long long>(blocks),
                 dialect, goal);
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
  return std::fclose(table) == 0 ? 0 : 2;
}
