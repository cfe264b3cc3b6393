# Precompiles headers that most sources include, which halves the build time. The sets are in
# cmake/precompiled.
option(HAGEN_PRECOMPILED_HEADERS "Precompile common headers; OFF: each source parses its own includes" ON)

# hagen_precompile(TARGET SET): the target uses the precompiled headers of cmake/precompiled/SET.h.
# All targets of a set share the compiled result, so all are position-independent.
function(hagen_precompile target set)
  if(NOT HAGEN_PRECOMPILED_HEADERS)
    return()
  endif()
  set(shared hagen_precompiled_${set})
  if(NOT TARGET ${shared})
    set(source ${PROJECT_BINARY_DIR}/precompiled/${set}.cpp)
    file(GENERATE OUTPUT ${source} CONTENT "// Nothing but the headers.\n")
    add_library(${shared} OBJECT ${source})
    hagen_target(${shared})
    set_target_properties(${shared} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_precompile_headers(${shared} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled/${set}.h)
    target_link_libraries(${shared} PRIVATE Eigen3::Eigen)
    if(set MATCHES mrpt)
      target_link_libraries(${shared} PRIVATE mrpt::obs mrpt::maps)
    endif()
    if(set MATCHES tests)
      target_link_libraries(${shared} PRIVATE GTest::gmock)
    endif()
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL EXECUTABLE)
    target_compile_options(${target} PRIVATE -fPIC)  # CMake would use -fPIE, which needs another set
  else()
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  target_precompile_headers(${target} REUSE_FROM ${shared})
endfunction()
