# Installs the build tree into a clean prefix, and uses the filter there and from its sources, with all libraries of the
# other components hidden. cmake -DSOURCE= -DBUILD= -DSHARED= -DGENERATOR= -DCXX= -DLAUNCHER= -DCOMPONENTS= -P install.cmake
cmake_minimum_required(VERSION 3.21)
set(work ${BUILD}/install-test)
set(prefix ${work}/prefix)
file(REMOVE_RECURSE ${work})

# run([ERROR] EXPECTED COMMAND...): expects the command to succeed (with ERROR: to fail) and to print EXPECTED.
function(run expected)
  set(command ${ARGN})
  set(fails FALSE)
  if(command MATCHES "^ERROR;")
    list(POP_FRONT command)
    set(fails TRUE)
  endif()
  execute_process(COMMAND ${command} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE err)
  string(REGEX REPLACE "[ \n]+" " " text "${out}${err}")
  string(FIND "${text}" "${expected}" at)
  if((fails AND result EQUAL 0) OR (NOT fails AND NOT result EQUAL 0) OR at EQUAL -1)
    list(JOIN command " " command)
    message(FATAL_ERROR "${command}\nexit code ${result}; expected '${expected}' in\n${out}${err}")
  endif()
endfunction()

foreach(component filter mrpt dev)
  run("" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} --component ${component})
endforeach()

set(hidden "")
foreach(package mrpt-obs mrpt-maps mrpt-opengl embree yaml-cpp ZLIB BZip2 TBB nlohmann_json CLI11 nanoflann GTest
                PkgConfig)
  list(APPEND hidden -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
set(configure ${CMAKE_COMMAND} -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${prefix})
if(LAUNCHER)
  list(APPEND configure -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
endif()
set(project ${CMAKE_CURRENT_LIST_DIR}/project)
set(labels "78 of 7248 returns are RoI")

# With find_package. A shared library requires only Eigen.
set(alone ${hidden})
if(SHARED)
  list(APPEND alone -DCMAKE_DISABLE_FIND_PACKAGE_hwy=ON)
endif()
run("" ${configure} ${alone} -S ${project} -B ${work}/find_package)
run("" ${CMAKE_COMMAND} --build ${work}/find_package)
run(${labels} ${work}/find_package/labels)

# With pkg-config.
file(GLOB_RECURSE pc ${prefix}/*hagen-filter.pc)
get_filename_component(pc ${pc} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc})
execute_process(COMMAND pkg-config --cflags --libs hagen-filter OUTPUT_VARIABLE flags
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
if(flags MATCHES "(-l|/lib)mrpt")
  message(FATAL_ERROR "hagen-filter.pc: ${flags}")
endif()
separate_arguments(flags UNIX_COMMAND "${flags}")
get_filename_component(libraries ${pc} DIRECTORY)
run("" ${CXX} -std=c++17 ${project}/main.cpp -o ${work}/labels ${flags} -Wl,-rpath,${libraries})
run(${labels} ${work}/labels)

# With add_subdirectory, as shared libraries.
run("" ${configure} ${hidden} -S ${project} -B ${work}/add_subdirectory -DHAGEN_SOURCE=${SOURCE} -DBUILD_SHARED_LIBS=ON)
run("" ${CMAKE_COMMAND} --build ${work}/add_subdirectory)
run(${labels} ${work}/add_subdirectory/labels)
# Only the sources of the filter and of the project are compiled.
file(GLOB_RECURSE objects RELATIVE ${work}/add_subdirectory ${work}/add_subdirectory/*.o)
list(FILTER objects EXCLUDE REGEX "libs/(scan|filter)/|precompiled|main\\.cpp\\.o$")
if(objects)
  message(FATAL_ERROR "compiled for the filter alone: ${objects}")
endif()

# With FetchContent, built above.
run("" ${configure} ${hidden} -S ${project} -B ${work}/fetched -DHAGEN_SOURCE=${SOURCE} -DFETCHED=ON)

# Finds each component alone; components below MRPT also without MRPT.
set(finds ${configure} -S ${CMAKE_CURRENT_LIST_DIR}/components)
foreach(component ${COMPONENTS})
  run("" ${finds} -B ${work}/component/${component} -DCOMPONENTS=${component})
endforeach()
set(without_mrpt "")
foreach(package mrpt-obs mrpt-maps mrpt-opengl mrpt_obs mrpt_maps mrpt_viz)
  list(APPEND without_mrpt -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
run("" ${finds} ${without_mrpt} -B ${work}/without_mrpt "-DCOMPONENTS=base;settings;sensors;simulation;live")
run("obs" ERROR ${finds} ${without_mrpt} -B ${work}/mrpt -DCOMPONENTS=mrpt)
run("optional convert: FALSE" ${finds} ${without_mrpt} -B ${work}/optional -DCOMPONENTS=filter -DOPTIONAL=convert)
run("optional convert: TRUE" ${finds} -B ${work}/optional_found -DCOMPONENTS=filter -DOPTIONAL=convert)
run("hagen has no component 'filtre'; available: " ERROR ${finds} -B ${work}/unknown -DCOMPONENTS=filtre)
run("" ${finds} -B ${work}/all)

# The service starts the program of its prefix.
run("" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} --component tools)
run("ExecStart=${prefix}/bin/live-segment" grep ExecStart ${prefix}/lib/systemd/system/live-segment@.service)
