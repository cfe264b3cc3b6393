# Installs the build tree into a clean prefix, then builds and runs examples/find_package with it.
set(prefix ${BUILD}/find_package/prefix)
set(build ${BUILD}/find_package/build)
file(REMOVE_RECURSE ${BUILD}/find_package)
foreach(
  step
  "${CMAKE_COMMAND};--install;${BUILD};--prefix;${prefix}"
  "${CMAKE_COMMAND};-G;${GENERATOR};-S;${SOURCE}/examples/find_package;-B;${build};-DCMAKE_PREFIX_PATH=${prefix}"
  "${CMAKE_COMMAND};--build;${build}"
  "${build}/uses_hagen")
  execute_process(COMMAND ${step} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${step}")
  endif()
endforeach()
