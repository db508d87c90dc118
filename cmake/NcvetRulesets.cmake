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

# The same tables packed, each with all that it extends: ncvet_packer, which runs where ncvet is
# built, makes them. A build for another system builds it for this one first.
set(packed_table ${CMAKE_BINARY_DIR}/generated/packed_table.cpp)
if(CMAKE_CROSSCOMPILING)
  set(host ${CMAKE_BINARY_DIR}/host)
  set(packer ${host}/ncvet_packer)
  file(GLOB packer_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/formats/text/*.*
       ${CMAKE_SOURCE_DIR}/formats/finding/*.* ${CMAKE_SOURCE_DIR}/formats/dialect/*.*
       ${CMAKE_SOURCE_DIR}/formats/packed/*.* ${CMAKE_SOURCE_DIR}/formats/packed/tool/*.*)
  add_custom_command(
    OUTPUT ${packer}
    COMMAND ${CMAKE_COMMAND} -S ${CMAKE_SOURCE_DIR} -B ${host} -G ${CMAKE_GENERATOR} --log-level=WARNING
            -DCMAKE_BUILD_TYPE=Release -DNCVET_BATCHES=ON -DBUILD_TESTING=OFF
    COMMAND ${CMAKE_COMMAND} --build ${host} --target ncvet_packer
    DEPENDS ${packer_sources} ${ruleset_files}
    VERBATIM)
else()
  add_executable(ncvet_packer EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/formats/packed/tool/main.cpp
                 ${CMAKE_SOURCE_DIR}/formats/packed/packed_tables.cpp)
  target_link_libraries(ncvet_packer PRIVATE ncvet_dialect)
  ncvet_warnings(ncvet_packer)
  set(packer ncvet_packer)
endif()
add_custom_command(
  OUTPUT ${packed_table}
  COMMAND ${packer} ${packed_table}
  DEPENDS ${packer}
  VERBATIM)
target_sources(ncvet_packed PRIVATE ${packed_table})

# ncvet_schema writes the schemas and the reference of the tables: ./dev schema.
ncvet_layer(ncvet_schemas formats/schema 8 ncvet_dialect nlohmann_json::nlohmann_json)
add_executable(ncvet_schema EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/formats/schema/tool/main.cpp)
target_link_libraries(ncvet_schema PRIVATE ncvet_schemas)
ncvet_warnings(ncvet_schema)
