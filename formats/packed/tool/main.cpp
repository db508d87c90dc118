// Writes the packed form of the tables as a C++ source: part of the build.
#include "formats/packed/packed_tables.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/raw_ostream.h"

using namespace ncvet;

namespace {

/// A compiler need not take longer literals; those side by side are one.
constexpr size_t mostInLiteral = 4000;

void writeRow(llvm::raw_ostream &out, llvm::StringRef name, llvm::StringRef bytes) {
  out << "    {\"" << name << "\",\n     llvm::StringRef(";
  for (llvm::StringRef left = bytes; !left.empty();
       left = left.drop_front(std::min(left.size(), mostInLiteral))) {
    out << "\n         \"";
    for (const char byte : left.take_front(mostInLiteral)) {
      const auto value = uint8_t(byte);
      if (value >= ' ' && value < 0x7F && value != '"' && value != '\\' && value != '?')
        out << byte;
      else
        out << '\\' << char('0' + (value >> 6)) << char('0' + (value >> 3 & 7))
            << char('0' + (value & 7));
    }
    out << '"';
  }
  out << ", " << bytes.size() << ")},\n";
}

llvm::Error write(llvm::raw_ostream &out) {
  out << "// Made from rulesets/ by formats/packed/tool.\n#include "
         "\"formats/packed/packed_tables.h\"\n\n"
         "namespace ncvet {\nnamespace {\nconst RulesetFile table[] = {\n";
  auto index = loadIndex();
  if (!index)
    return index.takeError();
  writeRow(out, "", pack(*index));
  for (const DialectSummary &summary : index->dialects) {
    if (summary.abstract)
      continue;
    auto dialect = loadDialect(summary.id, builtinDialects());
    if (!dialect)
      return dialect.takeError();
    writeRow(out, summary.id, pack(**dialect));
  }
  out << "};\n} // namespace\n\nllvm::ArrayRef<RulesetFile> packedTables() { return table; }\n} // "
         "namespace ncvet\n";
  return llvm::Error::success();
}

} // namespace

int main(int count, char **arguments) {
  if (count != 2) {
    llvm::errs() << "ncvet_packer OUT.cpp\n";
    return 2;
  }
  std::error_code cannot;
  llvm::raw_fd_ostream out(arguments[1], cannot);
  if (cannot) {
    llvm::errs() << arguments[1] << ": " << cannot.message() << '\n';
    return 2;
  }
  if (llvm::Error wrong = write(out)) {
    llvm::errs() << llvm::toString(std::move(wrong)) << '\n';
    out.close();
    llvm::sys::fs::remove(arguments[1]);
    return 1;
  }
  return 0;
}
