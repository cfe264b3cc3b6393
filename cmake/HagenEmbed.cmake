# hagen_embed(TARGET HEADER NAMESPACE NAME FILE [NAME FILE...]): compiles text files into a target, each
# as the `const std::string_view NAME` that HEADER declares in NAMESPACE. A changed file is read again.
function(hagen_embed target header namespace)
  set(definitions "")
  while(ARGN)
    list(POP_FRONT ARGN name file)
    file(READ ${file} text)
    string(APPEND definitions "const std::string_view ${name} = R\"hagen_text(${text})hagen_text\";\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endwhile()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/EmbeddedTexts.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT
       "// Made when the project is configured.\n#include ${header}\n\nnamespace ${namespace} {\n\n@definitions@\n}  // namespace ${namespace}\n")
  target_sources(${target} PRIVATE ${source})
endfunction()

# hagen_find_script(VARIABLE FILE PACKAGE): a JavaScript library of this machine, from a Debian package.
function(hagen_find_script variable file package)
  find_file(${variable} ${file} PATHS /usr/share/javascript/chart.js /usr/share/javascript/three
                                      /usr/share/javascript/three/examples/js/controls
            DOC "For the pages of octomap-compare" NO_DEFAULT_PATH)
  if(NOT ${variable})
    message(FATAL_ERROR "${file} is missing: install the Debian package ${package}, or give its "
                        "place as -D${variable}=FILE")
  endif()
endfunction()
