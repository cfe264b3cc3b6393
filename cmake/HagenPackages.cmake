# Debian packages, built by scripts/package: libhagen (the filter), libhagen-mrpt (the other
# libraries), libhagen-dev, hagen-tools (programs, presets, documents, recordings), and
# python3-hagen. Components are defined in cmake/HagenTarget.cmake. The last two packages are
# self-contained (cmake/HagenArchives.cmake).
set(HAGEN_PACKAGE_VERSION ${PROJECT_VERSION}-1 CACHE STRING "Version of the Debian packages")
set(HAGEN_MAINTAINER "Hagen maintainers <hagen@users.noreply.github.com>" CACHE STRING "Maintainer of the Debian packages")
find_program(HAGEN_GZIP gzip REQUIRED)

# Package of each component. A new component needs a line here, in CPACK_COMPONENTS_ALL, and its
# description and dependencies below.
set(package_filter libhagen)
set(package_mrpt libhagen-mrpt)
set(package_dev libhagen-dev)
set(package_tools hagen-tools)
set(package_python python3-hagen)

set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_PACKAGE_NAME hagen)
set(CPACK_PACKAGE_CONTACT "${HAGEN_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL filter mrpt dev tools)
if(HAGEN_FILTER_ONLY)
  set(CPACK_COMPONENTS_ALL filter)
endif()
if(HAGEN_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
if(CMAKE_CROSSCOMPILING AND CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
endif()
set(CPACK_DEBIAN_PACKAGE_VERSION ${HAGEN_PACKAGE_VERSION})
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package_${component}})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION libs)
endforeach()

# The first line of each description is the summary; CPack would prepend the project's.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(about "Hagen separates near obstacles (regions of interest) from ground and distant
returns in the scans of a sparse LiDAR on board a drone, in real time and
without a map.
")
set(CPACK_DEBIAN_FILTER_DESCRIPTION "obstacle detection in sparse LiDAR scans: the filter
${about}
This package contains the filter for plain point arrays.")
set(CPACK_DEBIAN_MRPT_DESCRIPTION "obstacle detection in sparse LiDAR scans: MRPT libraries
${about}
This package contains the libraries for MRPT observations and logs, several
recording formats, simulation, evaluation and obstacle avoidance.")
set(CPACK_DEBIAN_DEV_DESCRIPTION "obstacle detection in sparse LiDAR scans: development files
${about}
This package contains headers, CMake packages, pkg-config files and examples.
The filter only needs Eigen; other components of find_package(hagen) need
libhagen-mrpt and the other recommended packages. Sensor presets are in
hagen-tools.")
set(CPACK_DEBIAN_TOOLS_DESCRIPTION "obstacle detection in sparse LiDAR scans: programs
${about}
This package contains programs that segment recordings (MRPT rawlogs, network
captures, ROS bags, point clouds), simulate flights, score segmentations,
and compare obstacle avoidance with and without a map.")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "obstacle detection in sparse LiDAR scans: Python module
${about}
This package contains the module hagen for Python 3: the filter for NumPy
arrays, recordings, simulation and scores.")

set(same "(= ${HAGEN_PACKAGE_VERSION})")
set(CPACK_DEBIAN_MRPT_PACKAGE_DEPENDS "libhagen ${same}")
# Without libhagen-mrpt, because the filter alone needs no MRPT.
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libhagen ${same}, libeigen3-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS
    "libhagen-mrpt ${same}, hagen-tools ${same}, libmrpt-obs-dev, libmrpt-maps-dev, libmrpt-opengl-dev, liboctomap-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS python3-matplotlib)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS mrpt-apps)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION science)
# A module is built for one minor version of Python.
if(HAGEN_BUILD_PYTHON)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(python ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= ${python}), python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, hagen-tools")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
endif()

# Documents: those for users in hagen-tools, and those that Debian requires in each package.
set(documents ${CMAKE_INSTALL_DATADIR}/doc)
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${documents}/hagen-tools COMPONENT tools)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${documents}/hagen-tools COMPONENT tools
        PATTERN Doxyfile EXCLUDE PATTERN "*.tar.xz" EXCLUDE PATTERN site EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/docs/cpp.md ${PROJECT_SOURCE_DIR}/docs/mrpt.md
        DESTINATION ${documents}/libhagen-dev COMPONENT dev)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${documents}/libhagen-dev COMPONENT dev
        PATTERN python EXCLUDE REGEX "examples/CMakeLists.txt$" EXCLUDE)
if(HAGEN_BUILD_PYTHON)
  install(FILES ${PROJECT_SOURCE_DIR}/docs/python.md DESTINATION ${documents}/python3-hagen COMPONENT python)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/python/ DESTINATION ${documents}/python3-hagen/examples
          COMPONENT python)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/rawlogs DESTINATION ${CMAKE_INSTALL_DATADIR}/hagen COMPONENT tools)

file(READ ${PROJECT_SOURCE_DIR}/LICENSE BSD_TEXT)
string(REGEX REPLACE "^.*reserved\\.\n+|^[^\n]*\n+Copyright[^\n]*\n+" "" BSD_TEXT "${BSD_TEXT}")
string(REGEX REPLACE "\n+$" "" BSD_TEXT "${BSD_TEXT}")
string(REPLACE "\n\n" "\n.\n" BSD_TEXT "${BSD_TEXT}")
string(REPLACE "\n" "\n " BSD_TEXT " ${BSD_TEXT}")
set(package_dir ${PROJECT_BINARY_DIR}/package)
configure_file(${PROJECT_SOURCE_DIR}/cmake/debian/copyright ${package_dir}/copyright @ONLY)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${package_dir}/changelog.Debian
     "hagen (${HAGEN_PACKAGE_VERSION}) unstable; urgency=medium\n\n  * Packages of version ${PROJECT_VERSION}, built by scripts/package.\n\n -- ${HAGEN_MAINTAINER}  ${now}\n")
configure_file(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${package_dir}/changelog COPYONLY)
execute_process(COMMAND ${HAGEN_GZIP} -9nf changelog.Debian changelog WORKING_DIRECTORY ${package_dir}
                COMMAND_ERROR_IS_FATAL ANY)
foreach(component ${CPACK_COMPONENTS_ALL})
  install(FILES ${package_dir}/copyright ${package_dir}/changelog.Debian.gz ${package_dir}/changelog.gz
          DESTINATION ${documents}/${package_${component}} COMPONENT ${component})
endforeach()
file(WRITE ${package_dir}/triggers "activate-noawait ldconfig\n")
set(CPACK_POST_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian/without_ldconfig.cmake)
set(CPACK_DEBIAN_FILTER_PACKAGE_CONTROL_EXTRA ${package_dir}/triggers)
set(CPACK_DEBIAN_MRPT_PACKAGE_CONTROL_EXTRA ${package_dir}/triggers)
# Compiled Python files are created and removed with the package.
file(WRITE ${package_dir}/postinst "#!/bin/sh\nset -e\nif [ \"$1\" = configure ]; then\n  py3compile -p python3-hagen\nfi\n")
file(WRITE ${package_dir}/prerm "#!/bin/sh\nset -e\npy3clean -p python3-hagen\n")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${package_dir}/postinst ${package_dir}/prerm)
include(CPack)

# The contents of the packages, without tests; built by scripts/package.
add_custom_target(packaged)
get_property(libraries GLOBAL PROPERTY HAGEN_LIBRARIES)
get_property(programs GLOBAL PROPERTY HAGEN_PROGRAMS)
list(TRANSFORM libraries PREPEND hagen_)
foreach(target ${libraries} ${programs})
  add_dependencies(packaged ${target})
  if(TARGET ${target}-manual)
    add_dependencies(packaged ${target}-manual)
  endif()
endforeach()
