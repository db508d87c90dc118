# The page of the HTML report, compiled into ncvet_reports.
set(viewer_root ${CMAKE_SOURCE_DIR}/formats/reports/viewer)
file(GLOB viewer_files CONFIGURE_DEPENDS ${viewer_root}/*.js ${viewer_root}/*.css ${viewer_root}/*.html)
set(viewer_table ${CMAKE_BINARY_DIR}/generated/viewer_table.cpp)
add_custom_command(
  OUTPUT ${viewer_table}
  COMMAND ${CMAKE_COMMAND} -DROOT=${viewer_root} -DOUT=${viewer_table}
          -P ${CMAKE_SOURCE_DIR}/cmake/ViewerTable.cmake
  DEPENDS ${viewer_files} ${CMAKE_SOURCE_DIR}/cmake/ViewerTable.cmake
  VERBATIM)
target_sources(ncvet_reports PRIVATE ${viewer_table})
