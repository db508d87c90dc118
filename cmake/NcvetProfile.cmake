# The program that is shipped is compiled twice: once to count what it does (`count`) and, when it has
# run on the programs of the benchmarks, once more by what was counted, and as a whole (`use`).
# `./dev build shipped` does both. What is told of findings, the server and the command line are not counted.
set(NCVET_PROFILE "" CACHE STRING "count: what is done, into the folder `counts`; use: by NCVET_COUNTS")
set(NCVET_COUNTS ${CMAKE_SOURCE_DIR}/build/counts CACHE PATH "A file of counts for each object")

if(NCVET_PROFILE)
  # Counts are named after the object's path below the build folder, and nothing in objects is new each time.
  set(profile -fprofile-prefix-path=${CMAKE_BINARY_DIR} -frandom-seed=ncvet)
  if(NCVET_PROFILE STREQUAL "count")
    list(APPEND profile -fprofile-generate=${CMAKE_BINARY_DIR}/counts)
    add_link_options(-fprofile-generate)
  else()
    # What never ran while it was counted is compiled as it is without counts. Tables are generated in
    # another folder than they were counted in.
    list(APPEND profile -fprofile-use=${NCVET_COUNTS} -fprofile-partial-training -Wno-missing-profile
                -Wno-coverage-mismatch -flto)
    add_link_options(-flto=auto)
  endif()
  add_compile_options("$<$<BOOL:$<TARGET_PROPERTY:NCVET_COUNTED>>:${profile}>")
endif()
