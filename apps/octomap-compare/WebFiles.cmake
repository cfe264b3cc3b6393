# Pages carry all that they need with them, and so does the program: its pages, and the libraries
# that draw charts (chart.js 3) and scenes (three.js).
function(hagen_web_library variable file package)
  find_file(${variable} ${file} PATHS /usr/share/javascript/chart.js /usr/share/javascript/three
                                      /usr/share/javascript/three/examples/js/controls
            DOC "For the pages of octomap-compare" NO_DEFAULT_PATH)
  if(NOT ${variable})
    message(FATAL_ERROR "${file} is missing: install the Debian package ${package}, or give its "
                        "place as -D${variable}=FILE")
  endif()
endfunction()
hagen_web_library(HAGEN_CHART_JS chart.min.js libjs-chart.js)
hagen_web_library(HAGEN_THREE_JS three.min.js libjs-three)
hagen_web_library(HAGEN_ORBIT_CONTROLS_JS OrbitControls.js libjs-three)

set(HAGEN_WEB_FILES "")
function(hagen_web_file name file)
  file(READ ${file} text)
  string(APPEND HAGEN_WEB_FILES "const std::string_view ${name} = R\"hagen_web(${text})hagen_web\";\n")
  set(HAGEN_WEB_FILES "${HAGEN_WEB_FILES}" PARENT_SCOPE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
endfunction()
foreach(page report replay)
  foreach(kind html css js)
    hagen_web_file(${page}_${kind} ${CMAKE_CURRENT_SOURCE_DIR}/web/${page}.${kind})
  endforeach()
endforeach()
hagen_web_file(chart_js ${HAGEN_CHART_JS})
hagen_web_file(three_js ${HAGEN_THREE_JS})
hagen_web_file(orbit_controls_js ${HAGEN_ORBIT_CONTROLS_JS})
configure_file(WebFiles.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/WebFiles.cpp @ONLY)
