# Writes the files of formats/reports/viewer as C++ string tables: name ("page.html") and text.
file(GLOB files RELATIVE ${ROOT} ${ROOT}/*.js ${ROOT}/*.css ${ROOT}/*.html)
list(SORT files)
set(rows "")
foreach(name IN LISTS files)
  file(READ ${ROOT}/${name} text HEX)
  # Bytes as hexadecimal characters of short strings: neither their number nor their meaning in C++ or
  # in lists of CMake matters.
  string(REGEX REPLACE "(................................................................)" "\\1\n" text "${text}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" text "${text}")
  string(REPLACE "\n" "\"\n     \"" text "${text}")
  string(APPEND rows "    {\"${name}\",\n     \"${text}\"},\n")
endforeach()
file(WRITE ${OUT} "// Made from formats/reports/viewer/ by cmake/ViewerTable.cmake.\n#include \"formats/reports/viewer_files.h\"\n\nnamespace ncvet {\nnamespace {\nconst ViewerFile table[] = {\n${rows}};\n} // namespace\n\nllvm::ArrayRef<ViewerFile> viewerFiles() { return table; }\n} // namespace ncvet\n")
