# Compiles the sources of a target in batches: most of a small source's time goes into headers.
#
# A batch is a generated source that includes up to SIZE files of one folder by their paths from the
# top, so that a compiler cache serves clones at other places too. Names in unnamed namespaces must
# therefore be unique within a folder. The presets `debug` and `tidy` compile file by file, which
# keeps includes honest.
option(NCVET_BATCHES "Compile several sources at once" OFF)

# ncvet_batched(OUT NAME SIZE SOURCES...): sets OUT to what is to be compiled.
function(ncvet_batched out name size)
  if(NOT NCVET_BATCHES)
    set(${out} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  set(batches "")
  set(folders "")
  foreach(source IN LISTS ARGN)
    cmake_path(GET source PARENT_PATH folder)
    list(APPEND folders ${folder})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    file(RELATIVE_PATH room ${CMAKE_SOURCE_DIR} ${folder})
    string(REPLACE "/" "_" room ${room})
    set(sources ${ARGN})
    list(FILTER sources INCLUDE REGEX "^${folder}/[^/]*$")
    list(LENGTH sources left)
    # Batches of about the same length.
    math(EXPR parts "(${left} + ${size} - 1) / ${size}")
    foreach(part RANGE 1 ${parts})
      math(EXPR first "${left} * (${part} - 1) / ${parts}")
      math(EXPR length "${left} * ${part} / ${parts} - ${first}")
      list(SUBLIST sources ${first} ${length} members)
      set(text "")
      foreach(source IN LISTS members)
        file(RELATIVE_PATH path ${CMAKE_SOURCE_DIR} ${source})
        string(APPEND text "#include \"${path}\"\n")
      endforeach()
      set(batch ${CMAKE_BINARY_DIR}/batches/${name}/${room}_${part}.cpp)
      file(CONFIGURE OUTPUT ${batch} CONTENT "${text}" @ONLY)
      list(APPEND batches ${batch})
    endforeach()
  endforeach()
  set(${out} ${batches} PARENT_SCOPE)
endfunction()
