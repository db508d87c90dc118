# rulesets/**.json as text tables in the binary; part of the dialect layer, which loads them.
# The schemas are for editors and stay out of it.
file(GLOB_RECURSE ruleset_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/rulesets/*.json)
list(FILTER ruleset_files EXCLUDE REGEX "/rulesets/schema/")
set(ruleset_table ${CMAKE_BINARY_DIR}/generated/ruleset_table.cpp)
add_custom_command(
  OUTPUT ${ruleset_table}
  COMMAND ${CMAKE_COMMAND} -DROOT=${CMAKE_SOURCE_DIR}/rulesets -DOUT=${ruleset_table}
          -P ${CMAKE_SOURCE_DIR}/cmake/RulesetTable.cmake
  DEPENDS ${ruleset_files} ${CMAKE_SOURCE_DIR}/cmake/RulesetTable.cmake
  VERBATIM)
target_sources(ncvet_dialect PRIVATE ${ruleset_table})

# ncvet_schema writes the schemas and the reference of the tables: ./dev schema.
ncvet_layer(ncvet_schemas formats/schema 8 ncvet_dialect nlohmann_json::nlohmann_json)
add_executable(ncvet_schema EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/formats/schema/tool/main.cpp)
target_link_libraries(ncvet_schema PRIVATE ncvet_schemas)
ncvet_warnings(ncvet_schema)
